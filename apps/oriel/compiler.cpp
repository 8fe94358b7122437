// SPDX-License-Identifier: Apache-2.0
#include "compiler.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <sstream>

#include "command.h"

namespace oriel::app {
namespace {

/// Exit code of a program; 128 + signal when one ended it.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw UserError(fmt::format("cannot wait: {}", std::strerror(errno)));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The program's own, with messages in English: hints are found in them.
class Environment {
 public:
  Environment() {
    for (char** variable = environ; *variable != nullptr; ++variable)
      if (std::strncmp(*variable, "LC_ALL=", 7) != 0) words_.emplace_back(*variable);
    words_.emplace_back("LC_ALL=C");
    pointers_ = pointers_to(words_);
  }
  char* const* pointers() const { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;
};

/// Sends the messages of a program that is started to a file.
class MessageFile {
 public:
  explicit MessageFile(const std::string& path) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, path.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  ~MessageFile() { posix_spawn_file_actions_destroy(&actions_); }
  MessageFile(const MessageFile&) = delete;
  MessageFile& operator=(const MessageFile&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

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

bool Compiler::run(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<CompilerCommand> candidates;
  {
    const std::lock_guard guard(mutex_);
    candidates = candidates_;
  }
  const Environment environment;
  const MessageFile messages(log);
  std::vector<std::string> tried;
  for (const CompilerCommand& candidate : candidates) {
    CompilerCommand words = candidate;
    words.insert(words.end(), arguments.begin(), arguments.end());
    pid_t child = 0;
    const int error = posix_spawnp(&child, words[0].c_str(), messages.actions(), nullptr,
                                   pointers_to(words).data(), environment.pointers());
    if (error == 0) {
      const std::lock_guard guard(mutex_);
      candidates_ = {candidate};
    }
    if (error == 0) return wait_for(child) == 0;
    tried.push_back(fmt::format("'{}' ({})", words[0], std::strerror(error)));
  }
  throw UserError(
      fmt::format("there is no {} compiler: tried {}; install one (on Debian and Ubuntu: "
                  "apt install g++) or name one with {}",
                  language_, fmt::join(tried, ", "), option_));
}

}  // namespace oriel::app
