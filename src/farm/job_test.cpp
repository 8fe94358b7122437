// SPDX-License-Identifier: Apache-2.0
#include "farm/job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "support/files.h"

namespace oriel::farm {
namespace job_test {

class FarmJob : public ::testing::Test {
 protected:
  Job job() const {
    Job made;
    made.folder = std::filesystem::canonical(folder_.path()).string();
    made.name = "house";
    made.program = "/usr/bin/oriel";
    made.scene = "house.mi";
    made.output = folder_.file("#.exr");
    made.maps = true;
    made.frames = {1, 2, 7};
    made.outputs = {folder_.file("a b'\".1.exr"), folder_.file("2.exr"), folder_.file("7.exr")};
    made.parts = 4;
    made.chunk = 5;
    made.render = {"--samples", "4"};
    made.resources.time = "1:00:00";
    made.resources.further = {"--nice=7"};
    for (const char* name : {"units", "parts"})
      std::filesystem::create_directories(made.path(name));
    return made;
  }
  TestFolder folder_;
};

TEST_F(FarmJob, UnitsAreDividedAmongTasks) {
  const Job made = job();
  EXPECT_EQ(made.unit_count(), 12);
  EXPECT_EQ(made.task_count(), 3);
  EXPECT_EQ(made.units_of_task(0), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(made.units_of_task(2), (std::vector<int>{10, 11}));
  EXPECT_TRUE(made.units_of_task(3).empty());
  EXPECT_EQ(made.unit(9).frame, 7);
  EXPECT_EQ(made.unit(9).part, 2);
  EXPECT_EQ(made.unit_name(9), "frame 7, part 2 of 4");
}

TEST_F(FarmJob, ChunksFitIntoAnArray) {
  EXPECT_EQ(chunk_for(16, 1001), 1);
  EXPECT_EQ(chunk_for(1001, 1001), 1);
  EXPECT_EQ(chunk_for(1002, 1001), 2);
  EXPECT_EQ(chunk_for(9, 4), 3);
  EXPECT_EQ(chunk_for(9, 0), 9);
}

TEST_F(FarmJob, JobsAreReadAsWritten) {
  const Job made = job();
  write_job(made);
  const Job read = read_job(folder_.path().string());
  EXPECT_EQ(read.folder, made.folder);
  EXPECT_EQ(read.frames, made.frames);
  EXPECT_EQ(read.outputs, made.outputs);
  EXPECT_EQ(read.output, made.output);
  EXPECT_TRUE(read.maps);
  EXPECT_EQ(read.chunk, 5);
  EXPECT_EQ(read.render, made.render);
  EXPECT_EQ(read.resources.time, "1:00:00");
  EXPECT_EQ(read.resources.further, made.resources.further);
}

TEST_F(FarmJob, DamagedJobsAreRefused) {
  EXPECT_THROW(read_job(folder_.path().string()), std::runtime_error);
  write_job(job());
  const std::string whole = text_of(folder_.file("job.json"));
  for (const char* wrong : {"{}", "[]", "", "{\"name\":1}"}) {
    std::ofstream(folder_.file("job.json")) << wrong;
    EXPECT_THROW(read_job(folder_.path().string()), std::runtime_error) << wrong;
  }
  std::string zero = whole;
  zero.replace(zero.find("\"parts\": 4"), 10, "\"parts\": 0");
  std::ofstream(folder_.file("job.json")) << zero;
  EXPECT_THROW(read_job(folder_.path().string()), std::runtime_error);
}

TEST_F(FarmJob, AUnitIsDoneWithItsRecordAndItsFile) {
  const Job made = job();
  UnitRecord record;
  record.state = UnitRecord::State::Done;
  record.attempts = 2;
  record.message = "\xff broken text";
  EXPECT_EQ(read_record(made, 1).state, UnitRecord::State::Waiting);
  write_record(made, 1, record);
  EXPECT_EQ(read_record(made, 1).attempts, 2);
  EXPECT_FALSE(is_done(made, 1));
  std::ofstream(made.part_file(1, 2)) << "part";
  EXPECT_TRUE(is_done(made, 1));
  record.state = UnitRecord::State::Failed;
  write_record(made, 1, record);
  EXPECT_FALSE(is_done(made, 1));
}

TEST_F(FarmJob, DamagedRecordsAreWaiting) {
  const Job made = job();
  std::ofstream(made.record_file(0)) << "{\"state\":\"done\"";
  EXPECT_EQ(read_record(made, 0).state, UnitRecord::State::Waiting);
}

}  // namespace job_test
}  // namespace oriel::farm
