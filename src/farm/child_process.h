// SPDX-License-Identifier: Apache-2.0
// Runs programs: their output, their last message, and signals that are passed on to them.
#pragma once

#include <string>
#include <vector>

namespace oriel::farm {

/// What a program left behind.
struct ChildResult {
  int status = -1;  ///< exit status; 128 + N after signal N; 127: it could not be started
  std::string out;  ///< standard output, if captured
  /// The last error on standard error, else the last line that is not empty nor a hint.
  std::string last_message;
};

/// What happens to the output of a program. Its last message is noted in any case.
enum class ChildOutput : unsigned char {
  Inherit,  ///< both streams are those of this process
  Capture,  ///< standard output goes to the result
  Query,    ///< like Capture, and standard error is dropped
};

/// Runs a program of PATH with the arguments and waits for it.
///
/// Model:   signals of forward_signals() that arrive meanwhile are sent to the program.
/// Checked: ChildProcess.*
ChildResult run_child(const std::vector<std::string>& words, ChildOutput output);

/// Whether a program is in PATH.
bool is_in_path(const std::string& program);

/// From now on SIGUSR1, SIGTERM, SIGINT and SIGHUP do not end this process; they are noted and sent
/// to the program that run_child() runs.
void forward_signals();
/// The last signal noted; 0: none.
int noted_signal();

}  // namespace oriel::farm
