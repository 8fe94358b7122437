// SPDX-License-Identifier: Apache-2.0
// oriel status: the state of a job; oriel work: what its scripts run on the nodes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/durable_file.h"
#include "command.h"
#include "farm/child_process.h"
#include "farm/job_status.h"
#include "farm/slurm_text.h"
#include "farm/work.h"
#include "scene_file.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct StatusArguments {
  std::string job;
  bool json = false;
};

struct WorkArguments {
  std::string job;
  std::optional<int> task, maps;
  bool merge = false, all = false;
};

/// The folder of a job of Slurm, from its working directory.
std::string folder_of_id(const std::string& id) {
  const farm::ChildResult queue = farm::run_child(
      {"squeue", "-h", "-t", "all", "-j", id, "-o", "%Z"}, farm::ChildOutput::Query);
  std::string folder = queue.out.substr(0, queue.out.find('\n'));
  if (folder.empty()) {
    const farm::ChildResult history = farm::run_child(
        {"sacct", "-n", "-P", "-X", "-j", id, "-o", "WorkDir"}, farm::ChildOutput::Query);
    if (history.status == 0) folder = history.out.substr(0, history.out.find('\n'));
  }
  if (folder.empty())
    throw UserError(fmt::format("Slurm has no job {} any more; name the folder of the job", id));
  return folder;
}

/// The ids of the last array and its merge; empty if nothing was submitted.
std::vector<std::string> submitted_ids(const farm::Job& job) {
  const std::string text = first_bytes(job.path("units/submitted"), 64);
  std::vector<std::string> ids;
  const std::size_t blank = text.find(' ');
  for (const std::string& id :
       {text.substr(0, blank), blank == text.npos ? "" : text.substr(blank + 1)})
    if (const std::string valid = farm::parse_job_id(id); !valid.empty()) ids.push_back(valid);
  return ids;
}

std::optional<std::vector<farm::SlurmTask>> queued_tasks(const farm::Job& job) {
  const std::vector<std::string> ids = submitted_ids(job);
  if (ids.empty() || !farm::is_in_path("squeue")) return std::nullopt;
  const farm::ChildResult queue = farm::run_child(
      {"squeue", "-h", "-r", "-j", ids[0], "-o", "%i|%T|%R"}, farm::ChildOutput::Query);
  // Slurm forgets finished jobs, and says then that the id is invalid.
  const bool forgotten = queue.last_message.find("Invalid job id") != std::string::npos;
  if (queue.status != 0 && !forgotten) return std::nullopt;
  return farm::parse_squeue(queue.out);
}

nlohmann::json status_json(const farm::Job& job, const farm::JobStatus& s) {
  nlohmann::json failures = nlohmann::json::array();
  for (const auto& f : s.failures) {
    const farm::Job::Unit u = job.unit(f.unit);
    failures.push_back(
        {{"frame", u.frame}, {"part", u.part}, {"attempts", f.attempts}, {"message", f.message}});
  }
  nlohmann::json json = {
      {"name", job.name},     {"units", s.units},     {"done", s.done},
      {"running", s.running}, {"stopped", s.stopped}, {"waiting", s.waiting},
      {"failed", s.failed},   {"frames", s.frames},   {"frames_done", s.frames_done},
      {"failures", failures}};
  if (s.seconds_left) json["seconds_left"] = *s.seconds_left;
  return json;
}

int run_status(const StatusArguments& a) {
  std::error_code error;
  const bool is_id = !fs::exists(a.job, error) && !farm::parse_job_id(a.job).empty();
  const farm::Job job = farm::read_job(is_id ? folder_of_id(a.job) : a.job);
  const farm::JobStatus status = farm::job_status(job, queued_tasks(job));
  if (a.json)
    print_json(status_json(job, status));
  else
    fmt::print("{}", status_text(job, status));
  return status.failed > 0 ? kExitFailed : kExitDone;
}

/// On this machine, without a workload manager.
int work_on_all(const farm::Job& job) {
  for (;;) {
    for (const int task : farm::missing_tasks(job))
      if (const int status = farm::work_task(job, task); status == farm::kStopped) return status;
    // Noisy pixels may need another round.
    if (const int status = farm::work_merge(job, false); status != farm::kStopped) return status;
  }
}

int run_work(const WorkArguments& a) {
  if (int(a.task.has_value()) + int(a.maps.has_value()) + int(a.merge) + int(a.all) != 1)
    throw UsageError("one of --task, --maps, --merge and --all is required");
  const farm::Job job = farm::read_job(a.job);
  if (a.all) return work_on_all(job);
  if (a.merge) return farm::work_merge(job, farm::is_in_path("sbatch"));
  if (a.maps) {
    if (*a.maps >= static_cast<int>(job.frames.size()))
      throw UserError(fmt::format("the job has {} frames, from 0 on", job.frames.size()));
    return farm::work_maps(job, *a.maps);
  }
  if (*a.task >= job.task_count())
    throw UserError(fmt::format("the job has {} tasks, from 0 on", job.task_count()));
  return farm::work_task(job, *a.task);
}

}  // namespace

Command add_status_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("status", "Show the state of a job of oriel submit");
  auto a = std::make_shared<StatusArguments>();
  command->add_option("JOB", a->job, "Folder of the job, or its id in Slurm")->required();
  command->add_flag("--json", a->json, "Print a line of JSON");
  return {command, [a] { return run_status(*a); }};
}

Command add_work_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "work", "Render or merge units of a job; run by the scripts of oriel submit");
  auto a = std::make_shared<WorkArguments>();
  command->add_option("JOB", a->job, "Folder of the job")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--task", a->task, "Task to render, counted from 0")
      ->check(CLI::Range(0, 10'000'000));
  command->add_option("--maps", a->maps, "Frame whose maps are computed, counted from 0")
      ->check(CLI::Range(0, 10'000'000));
  command->add_flag("--merge", a->merge,
                    "Check and merge all parts; submit missing ones again if Slurm is there");
  command->add_flag("--all", a->all,
                    "Render and merge everything that is missing, on this machine");
  return {command, [a] { return run_work(*a); }};
}

}  // namespace oriel::app
