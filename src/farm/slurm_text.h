// SPDX-License-Identifier: Apache-2.0
// Text of Slurm's commands: what squeue, sacct, sbatch and scontrol print, and lists of array
// tasks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::farm {

/// A job or a task of a job array.
struct SlurmTask {
  std::string job;        ///< id of the job or array
  int task = -1;          ///< index in the array; -1: not a task of an array
  std::string state;      ///< RUNNING, PENDING, COMPLETED, FAILED, ...
  std::string reason;     ///< why it waits, or its node
  std::string exit_code;  ///< CODE:SIGNAL; of sacct only
};

/// Lines of `squeue -h -r -o %i|%T|%R`. Other lines are skipped.
/// Checked: SlurmText.*
std::vector<SlurmTask> parse_squeue(std::string_view text);

/// Lines of `sacct -n -P -X -o JobID,State,ExitCode`. Pending tasks of an array are one line,
/// `12_[3-5,9]`.
/// Checked: SlurmText.*
std::vector<SlurmTask> parse_sacct(std::string_view text);

/// The job id of `sbatch --parsable`, without the name of the cluster; empty if there is none.
/// Checked: SlurmText.*
std::string parse_job_id(std::string_view text);

/// A whole number of `scontrol show config`; unset if it is missing.
/// Checked: SlurmText.*
std::optional<int> parse_config_number(std::string_view text, std::string_view key);

/// Numbers of 1-4,7,9-13:2; a limit (%N) is ignored. Unset if the text has another form or more
/// than 4 million numbers.
/// Checked: SlurmText.*
std::optional<std::vector<int>> parse_task_list(std::string_view text);

/// The shortest form of ascending numbers: 0-3,7.
/// Checked: SlurmText.*
std::string task_list(const std::vector<int>& tasks);

}  // namespace oriel::farm
