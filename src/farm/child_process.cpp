// SPDX-License-Identifier: Apache-2.0
#include "farm/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/descriptor.h"

extern char** environ;

namespace oriel::farm {
namespace {

std::atomic<int> noted{0};
std::atomic<pid_t> running_child{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

constexpr std::array kForwarded = {SIGUSR1, SIGTERM, SIGINT, SIGHUP};

void note_and_forward(int signal) {
  const int error = errno;
  noted = signal;
  if (const pid_t child = running_child; child > 0) ::kill(child, signal);
  errno = error;
}

struct Pipe {
  Pipe() {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) == 0) read = Descriptor(ends[0]), write = Descriptor(ends[1]);
  }
  Descriptor read, write;
};

/// Keeps the last error, else the last line that is not empty nor a hint.
class LastLine {
 public:
  void add(std::string_view text) {
    for (const char c : text) {
      if (c != '\n' && c != '\r') {
        if (line_.size() < kLongest) line_ += c;
        continue;
      }
      end_line();
    }
  }
  std::string text() {
    end_line();
    return error_.empty() ? last_ : error_;
  }

 private:
  static constexpr std::size_t kLongest = 1000;
  void end_line() {
    const std::size_t text = line_.find_first_not_of(" \t");
    if (text != std::string::npos && line_.compare(text, 5, "hint:") != 0) last_ = line_;
    if (line_.find("error") != std::string::npos) error_ = line_;
    line_.clear();
  }
  std::string line_, last_, error_;
};

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // a lost log does not end a render
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// Reads both pipes to their end.
void read_pipes(const Descriptor& out, const Descriptor& err, bool quiet, ChildResult& result) {
  std::array<pollfd, 2> polled = {pollfd{out.get(), POLLIN, 0}, pollfd{err.get(), POLLIN, 0}};
  LastLine last;
  std::array<char, 4096> block{};
  while (polled[0].fd >= 0 || polled[1].fd >= 0) {
    if (::poll(polled.data(), polled.size(), -1) < 0 && errno != EINTR) break;
    for (pollfd& p : polled) {
      if (p.fd < 0 || p.revents == 0) continue;
      const ssize_t n = ::read(p.fd, block.data(), block.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) {
        p.fd = -1;
        continue;
      }
      const std::string_view text(block.data(), static_cast<std::size_t>(n));
      if (&p == polled.data()) {
        result.out += text;
      } else {
        if (!quiet) write_all(STDERR_FILENO, text);
        last.add(text);
      }
    }
  }
  result.last_message = last.text();
}

pid_t spawn_child(const std::vector<std::string>& words, const Pipe& out, const Pipe& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (out.write) posix_spawn_file_actions_adddup2(&actions, out.write.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write.get(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults, none;
  sigemptyset(&defaults);
  for (const int signal : kForwarded) sigaddset(&defaults, signal);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failed =
      ::posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : 0;
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& words, ChildOutput output) {
  ChildResult result;
  Pipe err;
  std::optional<Pipe> captured;
  if (output != ChildOutput::Inherit) captured.emplace();
  Pipe none;
  none.write = Descriptor(), none.read = Descriptor();
  Pipe& out = captured ? *captured : none;
  // A signal between the start of the program and the note of its process must not be lost.
  sigset_t blocked, before;
  sigemptyset(&blocked);
  for (const int signal : kForwarded) sigaddset(&blocked, signal);
  ::pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const pid_t child = spawn_child(words, out, err);
  running_child = child;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child == 0) {
    result.status = 127;
    result.last_message = words[0] + " could not be started";
    return result;
  }
  out.write = Descriptor();
  err.write = Descriptor();
  read_pipes(out.read, err.read, output == ChildOutput::Query, result);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  running_child = 0;
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return result;
}

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

void forward_signals() {
  struct sigaction action {};
  action.sa_handler = note_and_forward;
  action.sa_flags = SA_RESTART;
  for (const int signal : kForwarded) ::sigaction(signal, &action, nullptr);
}

int noted_signal() { return noted; }

}  // namespace oriel::farm
