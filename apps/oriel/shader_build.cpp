// SPDX-License-Identifier: Apache-2.0
#include "shader_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "command.h"
#include "compiler.h"
#include "image/atomic_file.h"
#include "include_shim.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

bool is_c(const fs::path& file) { return file.extension() == ".c"; }

bool is_source(const fs::path& file) {
  const std::string extension = file.extension().string();
  return is_c(file) || extension == ".cpp" || extension == ".cc" || extension == ".cxx" ||
         extension == ".C";
}

bool is_header(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h" || extension == ".hpp" || extension == ".hh" || extension == ".hxx";
}

/// The DllMain of a Windows library in a file of its own, as such folders often have one.
bool is_windows_entry(const fs::path& file) {
  std::string stem = file.stem().string();
  for (char& c : stem) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (stem.size() < 3 || stem.compare(stem.size() - 3, 3, "dll") != 0) return false;
  const std::string text = file_text(file);
  return text.find("windows.h") != std::string::npos && text.find("DllMain") != std::string::npos;
}

std::vector<std::string> files_in(const fs::path& folder, bool (*wanted)(const fs::path&)) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Where shader.h is: as asked, ORIEL_SDK, beside the installed program, in the source tree.
std::string find_headers(const std::string& asked) {
  std::error_code error;
  const auto checked = [](const std::string& folder, const char* who) {
    if (!fs::exists(fs::path(folder) / "shader.h"))
      throw UserError(fmt::format("{} '{}': there is no shader.h in it", who, folder));
    return folder;
  };
  if (!asked.empty()) return checked(asked, "--include");
  if (const char* said = std::getenv("ORIEL_SDK"); said != nullptr && *said != '\0')
    return checked(said, "ORIEL_SDK");
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "include" / "oriel" / "sdk";
  if (!error && fs::exists(installed / "shader.h", error)) return installed.string();
  if (fs::exists(fs::path(ORIEL_SDK_FOLDER) / "shader.h", error)) return ORIEL_SDK_FOLDER;
  throw UserError(
      fmt::format("the headers for shaders are not in '{}'; name their folder with "
                  "--include or ORIEL_SDK",
                  installed.string()));
}

/// Sources of the time rely on what compilers let pass then; newer ones are told to as well.
std::vector<std::string> dialect(bool c) {
  if (!c) return {"-std=gnu++14", "-fpermissive"};
  return {"-std=gnu99", "-Wno-error=implicit-function-declaration", "-Wno-error=implicit-int",
          "-Wno-error=int-conversion", "-Wno-error=incompatible-pointer-types"};
}

/// Where the compiler looks for headers.
std::vector<std::string> include_flags(const std::vector<std::string>& sources,
                                       const std::string& sdk, const TemporaryFolder& work) {
  std::vector<std::string> read = sources;
  std::vector<std::string> folders;
  for (const std::string& source : sources) {
    const std::string folder = (fs::path(source).parent_path() / "").string();
    if (std::find(folders.begin(), folders.end(), folder) != folders.end()) continue;
    folders.push_back(folder);
    for (std::string& header : files_in(folder.empty() ? "." : folder, is_header))
      read.push_back(std::move(header));
  }
  std::vector<StrayInclude> stray;
  const std::string shim = write_include_shim(read, sdk, work.file("include"), stray);
  for (const StrayInclude& s : stray)
    fmt::print(stderr, "oriel: {}:{}: there is no \"{}\" here; write #include <{}>\n", s.file,
               s.line, s.name, fs::path(s.name).filename().string());
  std::vector<std::string> flags = {"-I" + sdk};
  if (!shim.empty()) flags.push_back("-I" + shim);
  return flags;
}

}  // namespace

std::vector<std::string> find_shader_sources(const std::vector<std::string>& paths) {
  std::vector<std::string> sources;
  for (const std::string& path : paths) {
    if (!fs::exists(path)) throw UserError(fmt::format("there is no '{}'", path));
    if (!fs::is_directory(path)) {
      if (!is_source(path))
        throw UserError(fmt::format("'{}' is no source (.c, .cpp, .cc, .cxx)", path));
      sources.push_back(path);
      continue;
    }
    const std::vector<std::string> found = files_in(path, is_source);
    if (found.empty())
      throw UserError(fmt::format("'{}' has no sources (.c, .cpp, .cc, .cxx) in it", path));
    for (const std::string& file : found) {
      if (is_windows_entry(file))
        fmt::print(stderr, "oriel: {} is left out: the entry point of a Windows library\n", file);
      else
        sources.push_back(file);
    }
  }
  if (sources.empty()) throw UserError("there are no sources to build");
  return sources;
}

void build_shaders(const ShaderBuild& build) {
  const std::string sdk = find_headers(build.include);
  const TemporaryFolder work;
  const std::vector<std::string> includes = include_flags(build.sources, sdk, work);
  Compiler cc("C", "--cc", build.cc, "CC", {"cc", "gcc", "clang"});
  Compiler cxx("C++", "--cxx", build.cxx, "CXX", {"c++", "g++", "clang++"});

  std::vector<std::string> objects;
  std::size_t failed = 0;
  bool all_c = true;
  for (const std::string& source : build.sources) {
    const bool c = is_c(source);
    all_c = all_c && c;
    objects.push_back(work.file(fmt::format("{}.o", objects.size())));
    std::vector<std::string> arguments = dialect(c);
    for (const char* flag : {"-O2", "-fPIC", "-fno-strict-aliasing"}) arguments.emplace_back(flag);
    arguments.insert(arguments.end(), includes.begin(), includes.end());
    arguments.insert(arguments.end(), build.flags.begin(), build.flags.end());
    arguments.insert(arguments.end(), {"-c", source, "-o", objects.back()});
    if (!(c ? cc : cxx).run(arguments)) ++failed;
  }
  if (failed > 0)
    throw UserError(fmt::format("{} of {} sources did not compile; nothing was written", failed,
                                build.sources.size()));

  write_atomically(build.output, [&](const std::string& path) {
    std::vector<std::string> arguments = {"-shared", "-o", path};
    arguments.insert(arguments.end(), objects.begin(), objects.end());
    arguments.insert(arguments.end(), build.flags.begin(), build.flags.end());
    arguments.emplace_back("-lm");
    if (!(all_c ? cc : cxx).run(arguments))
      throw UserError("the sources could not be linked; nothing was written");
  });
}

}  // namespace oriel::app
