// SPDX-License-Identifier: Apache-2.0
// Signals, standard streams that cannot be written, and the time limit.
#include "fault_test.h"
#include "image/exr.h"

namespace oriel {
namespace signals_test {

class Signals : public FaultTest {
 protected:
  pid_t start_long() const {
    write("stdout.txt", "");  // of the run before
    return start_render({"-o", "a.exr", "--samples", "1000000", "--json"});
  }
};
using StandardStreams = FaultTest;

TEST_F(Signals, HangUpSavesThePicture) {
  for (const int number : {SIGHUP, SIGTERM}) {
    const pid_t child = start_long();
    ASSERT_TRUE(wait_for_text("\"pass\":2"));
    kill(child, number);
    if (number == SIGHUP) kill(child, number);  // a terminal sends it more than once
    const RunResult r = finish(child);
    EXPECT_EQ(r.exit_code, 1) << number;
    EXPECT_TRUE(there("a.exr"));
    std::filesystem::remove(file("a.exr"));
  }
}

TEST_F(Signals, HangUpIsIgnoredUnderNohup) {
  const RunResult r = shell(
      "trap '' HUP; \"$ORIEL\" render scene.mi -o a.exr --time 1 --json >stdout.txt & "
      "sleep .4; kill -HUP $!; wait $!");
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_NE(r.out.find("\"stopped_by\":\"time\""), std::string::npos) << r.out;
}

// The second signal may be another one.
TEST_F(Signals, TheSecondInterruptEndsAtOnce) {
  const pid_t child =
      start_render({"-o", "a.exr", "--size", "4000x3000", "--threads", "1", "--json"});
  ASSERT_TRUE(wait_for_text("\"stage\":\"picture\""));
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).exit_code, -1) << "ended by the signal";
  EXPECT_FALSE(there("a.exr"));
}

TEST_F(Signals, TheTimeLimitCountsFromTheStart) {
  // Reading this mesh takes longer than the limit.
  std::string mesh = "object \"grid\" visible group\n";
  for (int i = 0; i < 250 * 250; ++i)
    mesh += std::to_string(i % 250) + " 0 " + std::to_string(i / 250) + "\n";
  for (int i = 0; i < 250 * 250; ++i) mesh += "v " + std::to_string(i) + "\n";
  for (int i = 0; i < 249 * 250; ++i)
    if (i % 250 != 249)
      mesh += "p " + std::to_string(i) + " " + std::to_string(i + 1) + " " +
              std::to_string(i + 251) + " " + std::to_string(i + 250) + "\n";
  mesh += "end group end object\n";
  write("scene.mi", mesh + small_scene());
  const RunResult r = render({"-o", "a.exr", "--time", "0.01", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("\"stopped_by\":\"time\""), std::string::npos) << r.out;
  EXPECT_EQ(number_attribute(read_exr(file("a.exr")), "oriel.samples"), 1.0f);
}

TEST_F(StandardStreams, AClosedPipeKeepsThePicture) {
  const RunResult r = shell(
      "{ \"$ORIEL\" render scene.mi -o a.exr --samples 500 --json; echo $? >code.txt; } "
      "2>stderr.txt | head -n 1 >stdout.txt");
  EXPECT_EQ(text_of(file("code.txt")), "0\n") << r.err;
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(number_attribute(read_exr(file("a.exr")), "oriel.samples"), 500.0f);
}

TEST_F(StandardStreams, AClosedPipeOfMessagesKeepsThePicture) {
  const RunResult r =
      shell("{ \"$ORIEL\" render scene.mi -o a.exr --samples 4; echo $? >code.txt; } 2>&1 | true");
  EXPECT_EQ(text_of(file("code.txt")), "0\n") << r.err;
  EXPECT_TRUE(there("a.exr"));
}

TEST_F(StandardStreams, AFullDiskBehindThemIsReportedAndKeepsThePicture) {
  const RunResult r =
      shell("\"$ORIEL\" render scene.mi -o a.exr --samples 500 --json >/dev/full 2>stderr.txt");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("standard output"), std::string::npos) << r.err;
  EXPECT_EQ(number_attribute(read_exr(file("a.exr")), "oriel.samples"), 500.0f);
  for (const char* command : {"--help", "shaders", "check scene.mi"})
    EXPECT_EQ(shell(std::string("\"$ORIEL\" ") + command + " >/dev/full 2>stderr.txt").exit_code, 1)
        << command;
  EXPECT_EQ(shell("\"$ORIEL\" render scene.mi -o b.exr --samples 1 2>/dev/full").exit_code, 0);
}

}  // namespace signals_test
}  // namespace oriel
