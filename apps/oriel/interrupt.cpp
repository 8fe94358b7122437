// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <csignal>

namespace oriel::app {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // or a signal handler may not touch it

void on_signal(int number) {
  flag = true;
  std::signal(number, SIG_DFL);
}

}  // namespace

std::atomic<bool>& interrupted() { return flag; }

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

}  // namespace oriel::app
