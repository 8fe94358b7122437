// SPDX-License-Identifier: Apache-2.0
// Copies of the packed scene on the nodes.
#pragma once

#include <string>

#include "farm/job.h"

namespace oriel::farm {

/// The folder of the scene: that of the job, or its copy in Job::stage, which is made once on each
/// node. Falls back to that of the job, with a message, if the copy cannot be made or belongs to
/// another user.
/// Checked: Staging.*
std::string staged_scene(const Job& job);

}  // namespace oriel::farm
