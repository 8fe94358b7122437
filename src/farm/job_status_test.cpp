// SPDX-License-Identifier: Apache-2.0
#include "farm/job_status.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/files.h"

namespace oriel::farm {
namespace job_status_test {

using State = UnitRecord::State;

class JobStatusTest : public ::testing::Test {
 protected:
  JobStatusTest() {
    job_.folder = folder_.path().string();
    job_.name = "house";
    job_.frames = {1, 2, 3, 4, 5, 6};
    for (int i = 0; i < 6; ++i) job_.outputs.push_back(folder_.file("x" + std::to_string(i)));
    for (const char* name : {"units", "parts"})
      std::filesystem::create_directories(job_.path(name));
  }
  void record(int unit, State state, double seconds = 0, const std::string& message = "") const {
    write_record(job_, unit, {state, 2, seconds, "n1", "7", message});
    if (state == State::Done) std::ofstream(job_.output_of(unit / job_.parts)) << "picture";
  }
  TestFolder folder_;
  Job job_;
};

TEST_F(JobStatusTest, UnitsAreCountedByTheirRecords) {
  record(0, State::Done, 100);
  record(1, State::Done, 300);
  record(2, State::Running);
  record(3, State::Failed, 5, "cannot open texture");
  record(4, State::Stopped, 50);
  const JobStatus s = job_status(job_, std::nullopt);
  EXPECT_EQ(s.done, 2);
  EXPECT_EQ(s.running, 1);
  EXPECT_EQ(s.failed, 1);
  EXPECT_EQ(s.stopped, 1);
  EXPECT_EQ(s.waiting, 1);
  EXPECT_EQ(s.frames_done, 2);
  EXPECT_FALSE(s.is_finished());
  // Three units one after the other at 200 s; half of the first one is behind.
  EXPECT_DOUBLE_EQ(s.seconds_left.value(), 2.5 * 200);
  const std::string text = status_text(job_, s);
  EXPECT_EQ(text,
            "house: 2 of 6 frames done, 1 running, 1 stopped, 1 waiting, 1 failed; about 0:08:20 "
            "left\nframe 4 failed (attempt 2): cannot open texture\n");
}

TEST_F(JobStatusTest, TasksOfDeadNodesDoNotRun) {
  record(2, State::Running);
  const std::vector<SlurmTask> running = {{"7", 2, "RUNNING", "n1", ""}};
  const std::vector<SlurmTask> pending = {{"7", 2, "PENDING", "(BeginTime)", ""}};
  EXPECT_EQ(job_status(job_, running).running, 1);
  EXPECT_EQ(job_status(job_, pending).running, 0);
  EXPECT_EQ(job_status(job_, std::vector<SlurmTask>{}).running, 0);
  EXPECT_EQ(job_status(job_, std::nullopt).running, 1);
}

TEST_F(JobStatusTest, APictureThatWasDeletedIsNotDone) {
  record(0, State::Done, 10);
  std::filesystem::remove(job_.output_of(0));
  EXPECT_EQ(job_status(job_, std::nullopt).done, 0);
}

TEST_F(JobStatusTest, Clocks) {
  EXPECT_EQ(clock_text(3661.4), "1:01:01");
  EXPECT_EQ(clock_text(-5), "0:00:00");
}

}  // namespace job_status_test
}  // namespace oriel::farm
