// SPDX-License-Identifier: Apache-2.0
// Standard streams whose errors do not end a render, and the start of the process.
#pragma once

#include <chrono>

namespace oriel::app {

/// Model:   control characters other than line feed and tab are written as escapes: see
///          base/printable.h. A closed pipe (`oriel ... | head`) drops further text quietly. Errors
///          of standard
/// output
///          are remembered; errors of standard error are ignored. The signals SIGPIPE and SIGXFSZ
///          (file size limit) no longer end the process; the writes fail instead.
void prepare_process();

/// Returns the cursor of the terminal to the start of the line and clears the line.
void clear_line();

/// When prepare_process() was called.
std::chrono::steady_clock::time_point process_start();

/// Flushes standard output. Returns the exit code: kExitFailed instead of kExitDone, with a
/// message, if text was lost for another reason than a closed pipe. Checked: StandardStreams.* in
/// tests/faults
int close_streams(int exit_code);

}  // namespace oriel::app
