// SPDX-License-Identifier: Apache-2.0
#include "farm/job_scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "farm/slurm_text.h"

namespace oriel::farm {
namespace {

/// Lines that both scripts have.
std::string script_head(const Job& job, const std::string& purpose, const std::string& log,
                        int nodes = 1) {
  const JobResources& r = job.resources;
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# Written by oriel submit: {}\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --output=log/{}.log\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --requeue\n"
      "#SBATCH --nodes={}\n"
      "#SBATCH --ntasks={}\n",
      purpose, job.name, log, nodes, nodes);
  if (nodes > 1) text += "#SBATCH --ntasks-per-node=1\n";
  if (!r.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", r.partition);
  if (!r.account.empty()) text += fmt::format("#SBATCH --account={}\n", r.account);
  return text;
}

/// Lines of the scripts that render.
std::string node_lines(const JobResources& r) {
  std::string text = fmt::format("#SBATCH --signal=B:USR1@{}\n", r.lead);
  text += r.cpus > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", r.cpus)
                     : std::string("#SBATCH --exclusive\n");
  if (!r.memory.empty()) text += fmt::format("#SBATCH --mem={}\n", r.memory);
  if (!r.time.empty()) text += fmt::format("#SBATCH --time={}\n", r.time);
  return text;
}

std::string script_end(const Job& job, const std::string& what) {
  return fmt::format("exec {} work {} {}\n", shell_quoted(job.program), shell_quoted(job.folder),
                     what);
}

std::vector<std::string> submission(const Job& job, const std::vector<std::string>& options,
                                    const char* script) {
  std::vector<std::string> words = {"sbatch", "--parsable", "--chdir=" + job.folder};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), job.resources.further.begin(), job.resources.further.end());
  words.push_back(job.path(script));
  return words;
}

bool needs_quotes(const std::string& word) {
  return word.empty() || !std::all_of(word.begin(), word.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 ||
                  std::string_view("_-./=:,+%@").find(static_cast<char>(c)) !=
                      std::string_view::npos;
         });
}

}  // namespace

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  }
  return quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + (needs_quotes(word) ? shell_quoted(word) : word);
  return line;
}

std::string render_script(const Job& job) {
  return script_head(job,
                     fmt::format("renders {} of {}", job.parts > 1 ? "parts" : "frames", job.name),
                     "task-%a", std::max(job.mpi, 1)) +
         node_lines(job.resources) + script_end(job, "--task \"$SLURM_ARRAY_TASK_ID\"");
}

std::string maps_script(const Job& job) {
  return script_head(job, fmt::format("computes maps of indirect light for {}", job.name),
                     "maps-%a") +
         node_lines(job.resources) + script_end(job, "--maps \"$SLURM_ARRAY_TASK_ID\"");
}

std::string merge_script(const Job& job) {
  std::string text = script_head(
      job, fmt::format("checks and merges {}, submits again what is missing", job.name), "merge");
  if (!job.resources.memory.empty())
    text += fmt::format("#SBATCH --mem={}\n", job.resources.memory);
  return text + script_end(job, "--merge");
}

std::vector<std::string> render_submission(const Job& job, const std::vector<int>& tasks,
                                           const std::string& after) {
  std::string array = task_list(tasks);
  if (job.resources.nodes > 0) array += fmt::format("%{}", job.resources.nodes);
  std::vector<std::string> options = {"--array=" + array};
  // Tasks compute maps that are missing.
  if (!after.empty()) options.push_back("--dependency=afterany:" + after);
  return submission(job, options, "render.sh");
}

std::vector<std::string> maps_submission(const Job& job) {
  return submission(job, {fmt::format("--array=0-{}", job.frames.size() - 1)}, "maps.sh");
}

std::vector<std::string> merge_submission(const Job& job, const std::string& after) {
  return submission(job, {"--dependency=afterany:" + after}, "merge.sh");
}

}  // namespace oriel::farm
