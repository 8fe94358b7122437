// SPDX-License-Identifier: Apache-2.0
// Signals that end a render: the first ends it with its picture, another one ends the program.
#pragma once

#include <atomic>

namespace oriel::app {

/// True from the first SIGINT, SIGTERM or SIGHUP on, and when a user's shader ends the render.
std::atomic<bool>& interrupted();

/// Installs the handlers. The second SIGINT or SIGTERM ends the program at once; SIGHUP never does,
/// and is ignored under nohup.
void catch_interrupts();

}  // namespace oriel::app
