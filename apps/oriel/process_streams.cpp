// SPDX-License-Identifier: Apache-2.0
#include "process_streams.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "base/printable.h"
#include "command.h"

namespace oriel::app {
namespace {

std::atomic<int> output_error{0};

/// Writes to the descriptor as far as possible; returns the error.
int write_text(int descriptor, const char* text, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, text, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    text += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

int write_text(int descriptor, const std::string& text) {
  return write_text(descriptor, text.data(), text.size());
}

/// The beginning of a character at the end of the standard output so far.
std::string& unfinished() {
  static std::string bytes;
  return bytes;
}

// An error would make fmt::print throw in the middle of a render: success is reported always.
// Names of files and scenes are part of any text, so control characters are escaped here.
ssize_t write_output(void*, const char* text, std::size_t size) {
  std::string whole = std::exchange(unfinished(), {}).append(text, size);
  unfinished() = whole.substr(whole.size() - incomplete_end(whole));
  whole.resize(whole.size() - unfinished().size());
  if (output_error == 0) output_error = write_text(STDOUT_FILENO, printable(whole));
  return static_cast<ssize_t>(size);
}
ssize_t write_message(void*, const char* text, std::size_t size) {
  write_text(STDERR_FILENO, printable({text, size}));
  return static_cast<ssize_t>(size);
}

void replace_stream(std::FILE*& stream, cookie_write_function_t* write, int buffering) {
  std::FILE* const made = fopencookie(nullptr, "w", {nullptr, write, nullptr, nullptr});
  if (made == nullptr) return;
  std::setvbuf(made, nullptr, buffering, BUFSIZ);
  stream = made;
}

std::chrono::steady_clock::time_point& start() {
  static std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();
  return at;
}

}  // namespace

void prepare_process() {
  start();
  // A handler, not SIG_IGN, which programs that this process starts would inherit.
  struct sigaction nothing {};
  nothing.sa_handler = [](int) {};
  nothing.sa_flags = SA_RESTART;
  for (const int number : {SIGPIPE, SIGXFSZ}) sigaction(number, &nothing, nullptr);
  replace_stream(stdout, write_output, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF);
  replace_stream(stderr, write_message, _IONBF);
}

std::chrono::steady_clock::time_point process_start() { return start(); }

void clear_line() { write_text(STDERR_FILENO, "\r\x1b[K"); }

int close_streams(int exit_code) {
  std::fflush(stdout);
  if (output_error == 0) output_error = write_text(STDOUT_FILENO, printable(unfinished()));
  const int error = output_error;
  if (error == 0 || error == EPIPE) return exit_code;
  fmt::print(stderr, "oriel: cannot write to standard output: {}\n", std::strerror(error));
  return exit_code == kExitDone ? kExitFailed : exit_code;
}

}  // namespace oriel::app
