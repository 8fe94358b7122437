// SPDX-License-Identifier: Apache-2.0
// The state of a job, from its records and from what the workload manager says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/job.h"
#include "farm/slurm_text.h"

namespace oriel::farm {

struct JobStatus {
  int units = 0, done = 0, running = 0, waiting = 0, stopped = 0, failed = 0;
  int frames = 0, frames_done = 0;  ///< pictures that exist and are complete
  double mean_seconds = 0;          ///< of the units that are done
  std::optional<double> seconds_left;
  struct Failure {
    int unit = 0, attempts = 0;
    std::string message;
  };
  std::vector<Failure> failures;
  bool is_finished() const { return frames_done == frames; }
};

/// The state of all units.
///
/// Inputs:  tasks: from squeue, of the arrays of this job; unset if there is no workload manager.
/// Model:   records are the truth about units that are done or failed. A unit that a record calls
///          running is counted as waiting if the workload manager knows the task and it does not
///          run, or does not know it at all: its node died. The time left is that of the units left
///          at the mean time of those done, on as many tasks as run now, or may run.
/// Checked: JobStatusTest.*
JobStatus job_status(const Job& job, const std::optional<std::vector<SlurmTask>>& tasks);

/// One line for each fact.
std::string status_text(const Job& job, const JobStatus& status);

/// H:MM:SS.
std::string clock_text(double seconds);

}  // namespace oriel::farm
