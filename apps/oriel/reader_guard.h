// SPDX-License-Identifier: Apache-2.0
// A damaged model ends the program with a message, not with a crash.
#pragma once

#include <array>
#include <csignal>
#include <string>
#include <vector>

namespace oriel::app {

/// While it lives, a fault of the program (a bad access, a failed assertion, a stack that is used
/// up) is reported as an error of the file that is being read; the program ends with exit code 1.
///
/// Model:   the library that reads models trusts sizes and indices that stand in them, and nothing
///          can be saved of a process whose memory it overwrote. So the handler only writes a
///          message that was made beforehand and leaves; it runs on a stack of its own. A file that
///          makes the reader write to memory of ours without any fault is not noticed.
/// Inputs:  path: as the user wrote it. One guard at a time, on the thread that reads.
/// Checked: ConvertTest.DamagedFileIsReported
class ReaderGuard {
 public:
  explicit ReaderGuard(const std::string& path);
  ~ReaderGuard();
  ReaderGuard(const ReaderGuard&) = delete;
  ReaderGuard& operator=(const ReaderGuard&) = delete;

 private:
  static constexpr std::array kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  std::array<struct sigaction, kSignals.size()> before_{};
  stack_t stack_before_{};
  std::vector<char> stack_;
};

}  // namespace oriel::app
