// SPDX-License-Identifier: Apache-2.0
// Scripts of a job for Slurm, and the commands that submit them.
#pragma once

#include <string>
#include <vector>

#include "farm/job.h"

namespace oriel::farm {

/// The text in single quotes for a POSIX shell, whatever it contains.
/// Checked: JobScripts.QuotedTextIsOneWord
std::string shell_quoted(const std::string& text);

/// The words as a line for a shell; quotes only where they are needed.
std::string shell_line(const std::vector<std::string>& words);

/// A script for sbatch that renders the units of one task, or merges.
///
/// Model:   the script replaces itself by oriel (`exec`), which therefore receives the signals of
///          Slurm. It has no paths in its #SBATCH lines: logs are relative to the folder of the
///          job, where it is submitted.
/// Checked: JobScripts.*, tests/farm
std::string render_script(const Job& job);
std::string merge_script(const Job& job);
/// Computes the maps of one frame: the task is the index of the frame.
std::string maps_script(const Job& job);

/// sbatch and its arguments; `after`: id of the job of the maps, or empty.
std::vector<std::string> render_submission(const Job& job, const std::vector<int>& tasks,
                                           const std::string& after = "");
std::vector<std::string> maps_submission(const Job& job);
/// Merges after the job with this id, whether it failed or not.
std::vector<std::string> merge_submission(const Job& job, const std::string& after);

}  // namespace oriel::farm
