// SPDX-License-Identifier: Apache-2.0
#include "farm/work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "base/durable_file.h"
#include "farm/child_process.h"
#include "farm/job_scripts.h"
#include "farm/pack_layout.h"
#include "farm/slurm_text.h"
#include "farm/staging.h"

namespace oriel::farm {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using State = UnitRecord::State;

constexpr double kMaxStagger = 600;  // seconds

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The processors that the workload manager gave to this task; empty: it did not say.
std::string given_threads() {
  const std::string cpus = variable("SLURM_CPUS_PER_TASK");
  return cpus.empty() ? variable("SLURM_CPUS_ON_NODE") : cpus;
}

class TaskWorker {
 public:
  TaskWorker(const Job& job, int task) : job_(job), task_(task) {}

  int run() {
    forward_signals();
    wait_for_turn();
    scene_ = staged_scene(job_);
    bool failed = false;
    for (const int unit : job_.units_of_task(task_)) {
      if (noted_signal() != 0) return stop();
      if (is_done(job_, unit)) continue;
      const State state = render(unit);
      if (state == State::Stopped) return stop();
      failed |= state == State::Failed;
    }
    return failed ? 1 : 0;
  }

 private:
  /// Spreads the first reads of a shared file system.
  void wait_for_turn() const {
    if (job_.stagger <= 0 || !variable("SLURM_RESTART_COUNT").empty()) return;
    const double seconds = std::min(job_.stagger * task_, kMaxStagger);
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && noted_signal() == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  std::vector<std::string> render_words(const Job::Unit& unit) const {
    std::vector<std::string> words = {job_.program,
                                      "render",
                                      scene_ + "/" + job_.scene,
                                      "-o",
                                      job_.part_output(unit.frame),
                                      "--part",
                                      fmt::format("{}/{}", unit.part, job_.parts),
                                      "--resume",
                                      job_.part_file(unit.frame, unit.part)};
    if (job_.frames.size() > 1 || unit.frame > 1)
      words.insert(words.end(), {"--frames", fmt::format("{}", unit.frame)});
    if (job_.libraries) words.insert(words.end(), {"--shader-path", scene_ + "/" + kPackedShaders});
    if (job_.code) words.emplace_back("--trust-code");
    if (const std::string threads = given_threads(); !threads.empty())
      words.insert(words.end(), {"--threads", threads});
    words.insert(words.end(), job_.render.begin(), job_.render.end());
    return words;
  }

  State render(int unit) {
    const Job::Unit u = job_.unit(unit);
    UnitRecord record = read_record(job_, unit);
    record.state = State::Running;
    ++record.attempts;
    record.node = variable("SLURMD_NODENAME");
    record.task = variable("SLURM_JOB_ID");
    record.message.clear();
    write_record(job_, unit, record);
    fmt::print(stderr, "{}: attempt {}{}{}\n", job_.unit_name(unit), record.attempts,
               record.node.empty() ? "" : " on ", record.node);
    const auto begin = Clock::now();
    ChildResult result = run_child(render_words(u), ChildOutput::Inherit);
    if (result.status == 0 && job_.parts == 1) result = merge_frame(job_, unit);
    record.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    record.state = result.status == 0          ? State::Done
                   : result.status == kStopped ? State::Stopped
                                               : State::Failed;
    // A process that a signal of ours ended is not faulty.
    if (record.state == State::Failed && noted_signal() != 0) record.state = State::Stopped;
    if (record.state == State::Failed)
      record.message = result.last_message.empty() ? fmt::format("exit status {}", result.status)
                                                   : result.last_message;
    write_record(job_, unit, record);
    return record.state;
  }

  int stop() const {
    if (noted_signal() != SIGUSR1) return kStopped;
    const std::string id = variable("SLURM_JOB_ID");
    if (!id.empty() && is_in_path("scontrol"))
      run_child({"scontrol", "requeue", id}, ChildOutput::Inherit);
    return kStopped;
  }

 public:
  /// The parts of the frame of a unit to its picture. The parts are removed.
  static ChildResult merge_frame(const Job& job, int unit) {
    const int index = unit / job.parts, frame = job.unit(unit).frame;
    std::vector<std::string> words = {job.program, "merge"};
    for (int part = 1; part <= job.parts; ++part) words.push_back(job.part_file(frame, part));
    words.insert(words.end(), {"-o", job.output_of(index)});
    ChildResult result = run_child(words, ChildOutput::Inherit);
    std::error_code ignored;
    if (result.status == 0)
      for (int part = 1; part <= job.parts; ++part) fs::remove(job.part_file(frame, part), ignored);
    return result;
  }

 private:
  const Job& job_;
  int task_;
  std::string scene_;  // folder
};

/// How often missing units were submitted again.
int read_round(const Job& job) {
  const std::string text = first_bytes(job.path("units/round"), 16);
  int round = 0;
  std::from_chars(text.data(), text.data() + text.size(), round);
  return round;
}

std::vector<int> missing_units(const Job& job) {
  std::vector<int> missing;
  for (int i = 0; i < job.unit_count(); ++i)
    if (!is_done(job, i)) missing.push_back(i);
  return missing;
}

void print_missing(const Job& job, const std::vector<int>& units) {
  for (const int unit : units) {
    const UnitRecord record = read_record(job, unit);
    fmt::print(stderr, "{}: {}\n", job.unit_name(unit),
               record.message.empty() ? "not rendered" : record.message);
  }
}

/// Merges frames with all parts. Returns whether all those exist then.
bool merge_complete_frames(const Job& job) {
  bool all = true;
  for (int index = 0; index < static_cast<int>(job.frames.size()); ++index) {
    const int first = index * job.parts;
    std::error_code error;
    bool complete = true, any = false;
    for (int part = 0; part < job.parts; ++part) {
      complete &= is_done(job, first + part);
      any |= fs::exists(job.part_file(job.unit(first).frame, part + 1), error);
    }
    if (!complete) continue;
    if (!any && has_picture(job, index)) continue;  // merged before
    all &= TaskWorker::merge_frame(job, first).status == 0;
  }
  return all;
}

}  // namespace

int work_task(const Job& job, int task) { return TaskWorker(job, task).run(); }

std::vector<int> missing_tasks(const Job& job) {
  std::vector<int> tasks;
  for (const int unit : missing_units(job))
    if (tasks.empty() || tasks.back() != unit / job.chunk) tasks.push_back(unit / job.chunk);
  return tasks;
}

std::string submit_tasks(const Job& job, const std::vector<int>& tasks) {
  const auto submit = [](const std::vector<std::string>& words) {
    const ChildResult result = run_child(words, ChildOutput::Capture);
    std::string id = parse_job_id(result.out);
    if (result.status != 0 || id.empty())
      throw std::runtime_error(fmt::format(
          "sbatch failed: {}", result.last_message.empty() ? result.out : result.last_message));
    return id;
  };
  std::string array = submit(render_submission(job, tasks));
  const std::string merge = submit(merge_submission(job, array));
  write_durably(job.path("units/submitted"), fmt::format("{} {}\n", array, merge));
  return array;
}

int work_merge(const Job& job, bool may_submit) {
  const std::vector<int> missing = missing_units(job);
  const int round = read_round(job);
  const bool merged = merge_complete_frames(job);
  if (missing.empty()) return merged ? 0 : 1;
  print_missing(job, missing);
  if (!may_submit || round >= job.retries) {
    fmt::print(stderr, "{} of {} units are missing after {} repetition{}\n", missing.size(),
               job.unit_count(), round, round == 1 ? "" : "s");
    return 1;
  }
  write_durably(job.path("units/round"), fmt::format("{}\n", round + 1));
  const std::string id = submit_tasks(job, missing_tasks(job));
  fmt::print(stderr, "{} units are submitted again as job {}\n", missing.size(), id);
  return 0;
}

}  // namespace oriel::farm
