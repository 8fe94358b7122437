// SPDX-License-Identifier: Apache-2.0
#include "reader_guard.h"

#include <fmt/format.h>
#include <unistd.h>

#include "base/printable.h"
#include "command.h"

namespace oriel::app {
namespace {

constexpr std::size_t kStack = 64 * 1024;
/// Of the message; a path can be longer.
constexpr std::size_t kLongest = 8 * 1024;

char message[kLongest];
std::size_t message_size = 0;

/// Only what may be called in a handler.
void leave(int) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, message_size);
  _exit(kExitFailed);
}

}  // namespace

ReaderGuard::ReaderGuard(const std::string& path) : stack_(kStack) {
  const auto end = fmt::format_to_n(message, kLongest,
                                    "oriel: error: '{}' cannot be read: the importer failed; the "
                                    "file is probably damaged [OR-MD-001]\n",
                                    printable(path.substr(0, kLongest / 8)));
  message_size = std::min(end.size, kLongest);
  stack_t stack{};
  stack.ss_sp = stack_.data();
  stack.ss_size = stack_.size();
  sigaltstack(&stack, &stack_before_);
  struct sigaction action {};
  action.sa_handler = leave;
  action.sa_flags = SA_ONSTACK;
  sigfillset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
}

ReaderGuard::~ReaderGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  sigaltstack(&stack_before_, nullptr);
}

}  // namespace oriel::app
