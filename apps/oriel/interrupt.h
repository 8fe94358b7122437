// SPDX-License-Identifier: Apache-2.0
// Signals that end a render: the first ends it with its picture, another one ends the program.
// SIGUSR1 writes a checkpoint.
#pragma once

#include <atomic>

namespace oriel::app {

/// True from the first SIGINT, SIGTERM or SIGHUP on, and when a user's shader ends the render.
std::atomic<bool>& interrupted();

/// True from SIGUSR1 on, until it is set to false: write a checkpoint now.
std::atomic<bool>& checkpoint_requested();

/// Installs the handlers. The second SIGINT or SIGTERM ends the program at once; SIGHUP never does,
/// and is ignored under nohup.
void catch_interrupts();

/// From then on SIGUSR1 also sets interrupted().
void end_at_checkpoint_signal();

}  // namespace oriel::app
