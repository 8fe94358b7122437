// SPDX-License-Identifier: Apache-2.0
// What runs on the nodes: renders the units of a task, merges, and submits again what is missing.
#pragma once

#include "farm/job.h"

namespace oriel::farm {

/// Exit status of renders that wrote a checkpoint and can continue (EX_TEMPFAIL of sysexits.h).
inline constexpr int kStopped = 75;

/// Renders the units of a task that are not done, and records their state. Returns 0 if all are
/// done, 1 if one failed, kStopped after a signal.
///
/// Model:   each unit is a process `oriel render --part K/N`, which continues an existing part.
///          Maps of the job that are missing are computed first. After SIGUSR1 (the time limit is
///          near) the task of Slurm is requeued and continues from its checkpoints. After other
///          signals the workload manager decides. A failed unit does not end the task.
int work_task(const Job& job, int task);

/// Computes the maps of a frame, by its index, if the job has maps. Returns as work_task().
int work_maps(const Job& job, int frame_index);

/// Checks that all units are done and merges the parts of frames. If units are missing and the job
/// may retry, submits them again, followed by another merge; also if the merge of a frame whose
/// samples depend on noise asks for another round of its parts. Returns 0 if all pictures exist or
/// the units were submitted again, kStopped if units are to be rendered again but may not be
/// submitted, 1 otherwise.
int work_merge(const Job& job, bool may_submit);

/// Submits tasks and a merge after them. Returns the id of the array.
/// Errors:  std::runtime_error with the message of sbatch.
std::string submit_tasks(const Job& job, const std::vector<int>& tasks);

/// Tasks with units that are not done.
std::vector<int> missing_tasks(const Job& job);

}  // namespace oriel::farm
