// SPDX-License-Identifier: Apache-2.0
#include "shader_compile.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <mutex>
#include <thread>

#include "base/file_text.h"
#include "command.h"

namespace oriel::app {

ShaderCompilers::ShaderCompilers(const std::string& cc, const std::string& cxx,
                                 const std::vector<std::string>& standards, std::string work)
    : work_(std::move(work)),
      cc_("C", "--cc", cc, "CC", {"cc", "gcc", "clang"}),
      cxx_("C++", "--cxx", cxx, "CXX", {"c++", "g++", "clang++"}) {
  for (const std::string& standard : standards) choose_standard(standard);
}

void ShaderCompilers::choose_standard(const std::string& standard) {
  if (standard.find("++") != std::string::npos) {
    cxx_standard_ = standard;
    return;
  }
  // The headers have comments of C99, which GNU's C89 has as well.
  const bool c89 = standard == "c89" || standard == "c90" || standard == "iso9899:1990";
  c_standard_ = c89 ? "gnu89" : standard;
}

/// Flags that make new compilers accept what compilers of the time accepted.
std::vector<std::string> ShaderCompilers::dialect(bool c) const {
  if (!c) return {"-std=" + cxx_standard_, "-fpermissive", "-Wno-narrowing"};
  return {"-std=" + c_standard_,
          "-Wreturn-type",
          "-Wno-error=implicit-function-declaration",
          "-Wno-error=implicit-int",
          "-Wno-error=int-conversion",
          "-Wno-error=incompatible-pointer-types"};
}

/// Makes a C++ function that ends without `return` go back to its caller, as it does in C. Else
/// optimising compilers take its end as unreachable, and run on into whatever follows.
///
/// Clang has an option. GCC inserts no mark at the end when only the sanitizer of unreachable code
/// is on (cp_maybe_instrument_return); with traps in place of messages that needs no library.
std::vector<std::string> ShaderCompilers::safe_returns() {
  const std::string probe = work_ + "/probe.cpp";
  std::ofstream(probe) << "int probe() { return 0; }\n";
  for (const char* flags : {ORIEL_SHADER_RETURN_FLAGS_CLANG, ORIEL_SHADER_RETURN_FLAGS_GNU}) {
    const std::vector<std::string> words = words_of(flags);
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.end(), {"-Werror", "-c", probe, "-o", work_ + "/probe.o"});
    if (cxx_.run(arguments, work_ + "/probe.log")) return words;
  }
  return {"-Werror=return-type"};
}

std::size_t ShaderCompilers::compile(const std::vector<CompiledSource>& sources,
                                     const std::vector<std::string>& flags, int jobs,
                                     BuildHints& hints) {
  std::vector<std::string> languages[2] = {dialect(false), dialect(true)};
  if (std::any_of(sources.begin(), sources.end(), [](const CompiledSource& s) { return !s.c; }))
    for (const std::string& word : safe_returns()) languages[0].push_back(word);
  if (isatty(STDERR_FILENO))
    for (auto& language : languages) language.emplace_back("-fdiagnostics-color=always");

  std::atomic<std::size_t> next{0}, failed{0};
  std::mutex mutex;
  std::exception_ptr problem;
  std::vector<char> done(sources.size(), 0);
  std::size_t shown = 0;
  const auto show_done = [&] {
    for (; shown < sources.size() && done[shown]; ++shown) {
      const std::string messages = file_text(sources[shown].object + ".log");
      std::fwrite(messages.data(), 1, messages.size(), stderr);
      hints.read(messages);
    }
  };
  const auto work = [&] {
    for (std::size_t i; (i = next++) < sources.size();) try {
        const CompiledSource& source = sources[i];
        std::vector<std::string> arguments = languages[source.c];
        arguments.insert(arguments.end(), {"-O2", "-fPIC"});
        for (const std::string& flag : words_of(ORIEL_SHADER_FLAGS)) arguments.push_back(flag);
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        arguments.insert(arguments.end(), source.flags.begin(), source.flags.end());
        arguments.insert(arguments.end(), {"-c", source.source, "-o", source.object});
        if (!of(source.c).run(arguments, source.object + ".log")) ++failed;
        const std::lock_guard guard(mutex);
        done[i] = 1;
        show_done();
      } catch (...) {
        const std::lock_guard guard(mutex);
        problem = std::current_exception();
        next = sources.size();
      }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(jobs, static_cast<int>(sources.size())); ++i)
    threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (problem) std::rethrow_exception(problem);
  return failed;
}

}  // namespace oriel::app
