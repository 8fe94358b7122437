// SPDX-License-Identifier: Apache-2.0
// Ctrl-C: the first asks the render to end, the second ends the program.
#pragma once

#include <atomic>

namespace oriel::app {

/// True from the first SIGINT or SIGTERM on, and when a user's shader ends the render.
std::atomic<bool>& interrupted();

/// Installs the handlers.
void catch_interrupts();

}  // namespace oriel::app
