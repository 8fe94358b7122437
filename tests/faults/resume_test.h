// SPDX-License-Identifier: Apache-2.0
// Test support: renders that are stopped and resumed.
#pragma once

#include "fault_test.h"

namespace oriel {

/// Renders scene.mi with a checkpoint "a.chk".
class ResumeTest : public FaultTest {
 protected:
  using Words = std::vector<std::string>;
  static Words joined(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  /// The bytes of an uninterrupted render.
  std::vector<char> uninterrupted(const Words& options) const {
    const RunResult r = render(joined(options, {"-o", "whole.exr"}));
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return bytes_of(file("whole.exr"));
  }

  /// Renders to a.exr until a checkpoint exists, then ends the program by a signal.
  RunResult stop(const Words& options, int signal = SIGKILL, int checkpoints = 1) const {
    write("stdout.txt", "");  // of the run before
    const pid_t child =
        start_render(joined(options, {"-o", "a.exr", "--checkpoint", "a.chk,every .02", "--json"}));
    EXPECT_TRUE(wait_until([&] { return written_checkpoints() >= checkpoints; }))
        << text_of(file("stderr.txt"));
    kill(child, signal);
    return finish(child);
  }
  int written_checkpoints() const {
    const std::string out = text_of(file("stdout.txt")), event = "\"event\":\"checkpoint\"";
    int count = 0;
    for (std::size_t at = out.find(event); at != out.npos; at = out.find(event, at + 1)) ++count;
    return count;
  }

  /// Resumes a.chk to a.exr; returns its bytes.
  std::vector<char> resume(const Words& options) const {
    const RunResult r = render(joined(options, {"-o", "a.exr", "--resume", "a.chk"}));
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
    EXPECT_FALSE(there("a.chk")) << "a finished render removes it";
    return bytes_of(file("a.exr"));
  }

  /// Stops a render, resumes it with another number of threads and compares the file with that of
  /// an uninterrupted render.
  void expect_same_bytes(const Words& options, const std::string& what) const {
    const std::vector<char> whole = uninterrupted(options);
    stop(joined(options, {"--threads", "2"}));
    if (!there("a.chk")) {
      ADD_FAILURE() << what << ": the render ended before it was stopped";
      return;
    }
    EXPECT_TRUE(resume(joined(options, {"--threads", "1"})) == whole) << what;
  }

  /// Runs a command that has to fail with one line of message that contains all words; the
  /// checkpoint is not changed.
  void expect_refused(const Words& options, const Words& words) const {
    const std::vector<char> before = bytes_of(file("a.chk"));
    const RunResult r = render(joined(options, {"-o", "b.exr", "-q"}));
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
    for (const std::string& word : words)
      EXPECT_NE(r.err.find(word), std::string::npos) << word << ": " << r.err;
    EXPECT_FALSE(there("b.exr"));
    EXPECT_TRUE(bytes_of(file("a.chk")) == before) << r.err;
  }
};

}  // namespace oriel
