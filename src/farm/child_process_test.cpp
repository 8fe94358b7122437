// SPDX-License-Identifier: Apache-2.0
#include "farm/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace oriel::farm {
namespace child_process_test {

TEST(ChildProcess, OutputStatusAndLastMessage) {
  const ChildResult result =
      run_child({"sh", "-c", "echo out; echo first >&2; printf 'last\\n\\n' >&2; exit 7"},
                ChildOutput::Query);
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.last_message, "last");
}

TEST(ChildProcess, ErrorsComeBeforeOtherMessages) {
  const auto message = [](const std::string& lines) {
    return run_child({"sh", "-c", "printf '" + lines + "' >&2"}, ChildOutput::Query).last_message;
  };
  EXPECT_EQ(message("a: error: x\\n    hint: y\\n"), "a: error: x");
  EXPECT_EQ(message("note\\n    hint: y\\n"), "note");
  EXPECT_EQ(message("a: error: x\\nprogress\\n"), "a: error: x");
}

TEST(ChildProcess, SignalsAndMissingPrograms) {
  EXPECT_EQ(run_child({"sh", "-c", "kill -9 $$"}, ChildOutput::Capture).status, 128 + 9);
  EXPECT_EQ(run_child({"oriel-no-such-program"}, ChildOutput::Capture).status, 127);
  EXPECT_TRUE(is_in_path("sh"));
  EXPECT_FALSE(is_in_path("oriel-no-such-program"));
}

TEST(ChildProcess, SignalsArePassedOn) {
  EXPECT_EXIT(
      {
        forward_signals();
        // The parent of the shell is this process.
        const ChildResult result =
            run_child({"sh", "-c",
                       "trap 'exit 75' USR1; kill -USR1 $PPID; for i in 1 2 3 4 5 6 7 8 9; do "
                       "sleep 1; done"},
                      ChildOutput::Inherit);
        std::exit(result.status == 75 && noted_signal() == SIGUSR1 ? 42 : 1);
      },
      ::testing::ExitedWithCode(42), "");
}

}  // namespace child_process_test
}  // namespace oriel::farm
