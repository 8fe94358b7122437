// SPDX-License-Identifier: Apache-2.0
// Ctrl-C: the first asks the render to end, the second ends the program. Crashes of users' shaders.
#pragma once

#include <atomic>

namespace oriel::app {

/// True from the first SIGINT or SIGTERM on, and when a user's shader ends the render.
std::atomic<bool>& interrupted();

/// Installs the handlers.
void catch_interrupts();

/// Installs handlers that turn a crash in a user's shader into the end of the render: the picture
/// so far can be saved. Other crashes end the program as ever.
void catch_crashes();

}  // namespace oriel::app
