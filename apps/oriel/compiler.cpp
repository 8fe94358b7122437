// SPDX-License-Identifier: Apache-2.0
#include "compiler.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "command.h"

namespace oriel::app {
namespace {

CompilerCommand words_of(const std::string& text) {
  std::istringstream stream(text);
  CompilerCommand words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Exit code of a program; 128 + signal when one ended it.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw UserError(fmt::format("cannot wait: {}", std::strerror(errno)));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Compiler::Compiler(std::string language, std::string option, const std::string& asked,
                   const char* variable, const std::vector<std::string>& usual)
    : language_(std::move(language)), option_(std::move(option)) {
  const char* const said = std::getenv(variable);
  if (CompilerCommand one = words_of(asked); !one.empty())
    candidates_.push_back(std::move(one));
  else if (CompilerCommand other = words_of(said != nullptr ? said : ""); !other.empty())
    candidates_.push_back(std::move(other));
  else
    for (const std::string& name : usual) candidates_.push_back({name});
}

bool Compiler::run(const std::vector<std::string>& arguments) {
  std::fflush(nullptr);
  std::vector<std::string> tried;
  for (const CompilerCommand& candidate : candidates_) {
    CompilerCommand words = candidate;
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ);
    if (error == 0) {
      candidates_ = {candidate};
      return wait_for(child) == 0;
    }
    tried.push_back(fmt::format("'{}' ({})", words[0], std::strerror(error)));
  }
  throw UserError(
      fmt::format("there is no {} compiler: tried {}; install one (on Debian and Ubuntu: "
                  "apt install g++) or name one with {}",
                  language_, fmt::join(tried, ", "), option_));
}

}  // namespace oriel::app
