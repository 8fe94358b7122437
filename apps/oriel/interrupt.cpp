// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <signal.h>

namespace oriel::app {
namespace {

std::atomic<bool> flag{false}, checkpoint_flag{false}, checkpoint_ends{false};
std::atomic<int> requests{0};
// Otherwise a signal handler may not use them.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
  flag = true;
  // A closed terminal sends SIGHUP several times, and after SIGTERM.
  if (requests++ == 0 || number == SIGHUP) return;
  ::signal(number, SIG_DFL);
  ::raise(number);  // takes effect when the handler returns
}

void on_checkpoint_signal(int) {
  checkpoint_flag = true;
  if (checkpoint_ends) flag = true;
}

}  // namespace

std::atomic<bool>& interrupted() { return flag; }
std::atomic<bool>& checkpoint_requested() { return checkpoint_flag; }

void end_at_checkpoint_signal() { checkpoint_ends = true; }

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    // nohup ignores SIGHUP, and this remains so.
    if (number == SIGHUP && sigaction(number, nullptr, &before) == 0 &&
        before.sa_handler == SIG_IGN)
      continue;
    sigaction(number, &action, nullptr);
  }
  action.sa_handler = on_checkpoint_signal;
  sigaction(SIGUSR1, &action, nullptr);
}

}  // namespace oriel::app
