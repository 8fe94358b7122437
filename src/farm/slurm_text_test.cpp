// SPDX-License-Identifier: Apache-2.0
// Texts as printed by Slurm 22.05.8.
#include "farm/slurm_text.h"

#include <gtest/gtest.h>

namespace oriel::farm {
namespace slurm_text_test {

TEST(SlurmText, LinesOfSqueueGiveTasks) {
  const auto tasks = parse_squeue("1_2|PENDING|(BeginTime)\n1_1|RUNNING|n1\n7|COMPLETING|n2\n");
  ASSERT_EQ(tasks.size(), 3u);
  EXPECT_EQ(tasks[0].job, "1");
  EXPECT_EQ(tasks[0].task, 2);
  EXPECT_EQ(tasks[0].state, "PENDING");
  EXPECT_EQ(tasks[0].reason, "(BeginTime)");
  EXPECT_EQ(tasks[2].job, "7");
  EXPECT_EQ(tasks[2].task, -1);
}

TEST(SlurmText, OtherLinesAreSkipped) {
  EXPECT_TRUE(parse_squeue("slurm_load_jobs error: Invalid job id specified\n").empty());
  EXPECT_TRUE(parse_squeue("x_y|RUNNING|n1\n1_|RUNNING|n1\n-1|RUNNING|n1\n|||\n").empty());
}

TEST(SlurmText, LinesOfSacctGiveStatesAndExitCodes) {
  const auto tasks =
      parse_sacct("12_0|COMPLETED|0:0\n12_1|CANCELLED by 1000|0:15\n12_[3-4,9%2]|PENDING|0:0\n");
  ASSERT_EQ(tasks.size(), 5u);
  EXPECT_EQ(tasks[1].state, "CANCELLED");
  EXPECT_EQ(tasks[1].exit_code, "0:15");
  EXPECT_EQ(tasks[4].task, 9);
  EXPECT_EQ(tasks[4].state, "PENDING");
}

TEST(SlurmText, JobIdsOfSbatch) {
  EXPECT_EQ(parse_job_id("123\n"), "123");
  EXPECT_EQ(parse_job_id("123;cluster\n"), "123");
  EXPECT_EQ(parse_job_id("sbatch: error: invalid partition\n"), "");
  EXPECT_EQ(parse_job_id(""), "");
}

TEST(SlurmText, NumbersOfTheConfiguration) {
  const char* text =
      "MaxArraySizeX           = 7\nMaxArraySize            = 1001\nMaxDBDMsgs = x\n";
  EXPECT_EQ(parse_config_number(text, "MaxArraySize"), 1001);
  EXPECT_EQ(parse_config_number(text, "MaxDBDMsgs"), std::nullopt);
  EXPECT_EQ(parse_config_number(text, "Missing"), std::nullopt);
}

TEST(SlurmText, ListsOfTasks) {
  EXPECT_EQ(parse_task_list("1-4,7"), (std::vector<int>{1, 2, 3, 4, 7}));
  EXPECT_EQ(parse_task_list("0-9:4%3"), (std::vector<int>{0, 4, 8}));
  for (const char* wrong : {"", "a", "3-1", "1-", "1,,2", "1-9:0", "0-2000000000"})
    EXPECT_EQ(parse_task_list(wrong), std::nullopt) << wrong;
  EXPECT_EQ(task_list({0, 1, 2, 3, 7, 9, 10}), "0-3,7,9-10");
  EXPECT_EQ(task_list({}), "");
  EXPECT_EQ(parse_task_list(task_list({0, 2, 3, 9})), (std::vector<int>{0, 2, 3, 9}));
}

}  // namespace slurm_text_test
}  // namespace oriel::farm
