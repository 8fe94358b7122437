// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "command.h"
#include "sdk/crash.h"

namespace oriel::app {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // or a signal handler may not touch it

void on_signal(int number) {
  flag = true;
  std::signal(number, SIG_DFL);
}

void on_crash(int number) {
  sdk::leave_crashed_shader();  // returns only where no shader was running
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// A shader, or a handler of signals that its library installed, has called exit().
void on_exit() {
  const std::string shader = sdk::running_shader();
  if (shader.empty()) return;
  std::fprintf(stderr, "oriel: error: %s [OR-SDK-005]\n", shader.c_str());
  std::_Exit(kExitFailed);
}

}  // namespace

std::atomic<bool>& interrupted() { return flag; }

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void catch_crashes() {
  struct sigaction action = {};
  action.sa_handler = on_crash;
  // The handler jumps back into the program: the signal must not stay blocked.
  action.sa_flags = SA_NODEFER;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    sigaction(number, &action, nullptr);
  std::atexit(on_exit);
}

}  // namespace oriel::app
