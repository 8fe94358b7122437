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

#include "base/checkpoint_file.h"
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
constexpr int kMaxRounds = 1000;     // of a noise target; each doubles samples at most

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The processors that the workload manager gave to this task; empty: it did not say.
std::string given_threads() {
  const std::string cpus = variable("SLURM_CPUS_PER_TASK");
  return cpus.empty() ? variable("SLURM_CPUS_ON_NODE") : cpus;
}

/// Removes part files that cannot be read, so that they are rendered again. Returns whether there
/// were any.
bool remove_damaged_parts(const Job& job, int unit) {
  bool removed = false;
  for (const std::string& file : part_files(job, unit)) try {
      const CheckpointReader whole(file);
    } catch (const CheckpointError& e) {
      fmt::print(stderr, "{}: '{}' is rendered again: {}\n", job.unit_name(unit), file, e.what());
      std::error_code ignored;
      removed |= fs::remove(file, ignored);
    }
  return removed;
}

/// The parts of the frame of a unit to its picture. The parts are removed.
ChildResult merge_frame(const Job& job, int unit) {
  const int first = unit / job.parts * job.parts;
  std::vector<std::string> parts;
  for (int i = first; i < first + job.parts; ++i)
    for (std::string& file : part_files(job, i)) parts.push_back(std::move(file));
  std::vector<std::string> words = {job.program, "merge"};
  words.insert(words.end(), parts.begin(), parts.end());
  words.insert(words.end(), {"-o", job.output, "--scene", job.path("scene") + "/" + job.scene});
  if (job.libraries)
    words.insert(words.end(), {"--shader-path", job.path("scene") + "/" + kPackedShaders});
  if (job.code) words.emplace_back("--trust-code");
  // What the scene may do is not read from the parts.
  for (std::size_t i = 0; i < job.render.size(); ++i) {
    const std::string& word = job.render[i];
    if (word.starts_with("--budget") || word.starts_with("--allow") || word == "--untrusted")
      words.push_back(word);
    if ((word == "--budget" || word == "--allow") && i + 1 < job.render.size())
      words.push_back(job.render[i + 1]);
  }
  ChildResult result = run_child(words, ChildOutput::Inherit);
  std::error_code ignored;
  if (result.status == 0)
    for (const std::string& part : parts) fs::remove(part, ignored);
  return result;
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

  int run_maps(int frame_index) {
    forward_signals();
    scene_ = staged_scene(job_);
    const ChildResult result = render_maps(job_.unit(frame_index * job_.parts));
    if (noted_signal() != 0) return stop();
    return result.status == 0 ? 0 : 1;
  }

 private:
  /// Spreads the first reads of a shared file system.
  void wait_for_turn() const {
    if (job_.stagger <= 0 || !variable("SLURM_RESTART_COUNT").empty()) return;
    const double seconds = std::min(job_.stagger * task_, kMaxStagger);
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    if (seconds > 0) fmt::print(stderr, "task {} starts in {:.4g} s\n", task_, seconds);
    while (Clock::now() < end && noted_signal() == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  /// The command that renders a frame.
  std::vector<std::string> render_words(const Job::Unit& unit, const std::string& output) const {
    std::vector<std::string> words = {job_.program, "render",   scene_ + "/" + job_.scene,    "-o",
                                      output,       "--frames", fmt::format("{}", unit.frame)};
    if (job_.libraries) words.insert(words.end(), {"--shader-path", scene_ + "/" + kPackedShaders});
    if (job_.code) words.emplace_back("--trust-code");
    if (const std::string threads = given_threads(); !threads.empty())
      words.insert(words.end(), {"--threads", threads});
    words.insert(words.end(), job_.render.begin(), job_.render.end());
    return words;
  }

  ChildResult render_maps(const Job::Unit& unit) const {
    std::error_code error;
    if (!job_.maps || fs::exists(job_.maps_file(unit.frame), error)) return {0, {}, {}};
    std::vector<std::string> words = render_words(unit, job_.part_output());
    words.insert(words.end(), {"--maps-only", job_.maps_folder()});
    return run_child(words, ChildOutput::Inherit);
  }

  /// A picture that the nodes of the task render together, or this process alone if it runs without
  /// Slurm.
  ChildResult render_picture(const Job::Unit& u) const {
    const std::string checkpoint = job_.checkpoint_file(u.frame);
    std::vector<std::string> words = render_words(u, job_.output);
    words.insert(words.end(),
                 {"--checkpoint", checkpoint, "--resume", checkpoint, "--stop-at-usr1"});
    if (!variable("SLURM_JOB_ID").empty()) {
      std::vector<std::string> step = {"srun", "--mpi=pmix", "--kill-on-bad-exit=1",
                                       fmt::format("--nodes={}", job_.mpi),
                                       fmt::format("--ntasks={}", job_.mpi)};
      // Steps do not inherit the number of processors.
      if (const std::string cpus = given_threads(); !cpus.empty())
        step.push_back("--cpus-per-task=" + cpus);
      words.insert(words.begin(), step.begin(), step.end());
    }
    return run_child(words, ChildOutput::Inherit);
  }

  ChildResult render_part(const Job::Unit& u, int unit) const {
    if (job_.mpi > 0) return render_picture(u);
    ChildResult result = render_maps(u);
    if (result.status != 0) return result;
    std::vector<std::string> words = render_words(u, job_.part_output());
    words.insert(words.end(), {"--part", fmt::format("{}/{}", u.part, job_.parts)});
    if (job_.maps) words.insert(words.end(), {"--maps", job_.maps_folder()});
    for (int round = 0; round < kMaxRounds; ++round) {
      result = run_child(words, ChildOutput::Inherit);
      if (result.status != 0 || job_.parts > 1) return result;
      // The only part decides on the next round of a noise target itself.
      result = merge_frame(job_, unit);
      if (result.status != kStopped || noted_signal() != 0) return result;
    }
    return result;
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
    remove_damaged_parts(job_, unit);
    const auto begin = Clock::now();
    const ChildResult result = render_part(u, unit);
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

std::vector<int> tasks_of(const Job& job, const std::vector<int>& units) {
  std::vector<int> tasks;
  for (const int unit : units)
    if (tasks.empty() || tasks.back() != unit / job.chunk) tasks.push_back(unit / job.chunk);
  return tasks;
}

void print_missing(const Job& job, const std::vector<int>& units) {
  for (const int unit : units) {
    const UnitRecord record = read_record(job, unit);
    fmt::print(stderr, "{}: {}\n", job.unit_name(unit),
               record.message.empty() ? "not rendered" : record.message);
  }
}

/// What became of the frames whose parts are all done.
struct MergedFrames {
  bool failed = false;
  bool damaged = false;         ///< parts were removed
  std::vector<int> next_round;  ///< units whose pixels need more samples
};

MergedFrames merge_complete_frames(const Job& job) {
  MergedFrames merged;
  for (int index = 0; index < static_cast<int>(job.frames.size()); ++index) {
    const int first = index * job.parts;
    bool complete = true, any = false;
    for (int part = 0; part < job.parts; ++part) {
      complete &= is_done(job, first + part);
      any |= !part_files(job, first + part).empty();
    }
    if (!complete) continue;
    if (!any && has_picture(job, index)) continue;  // merged before
    const int status = merge_frame(job, first).status;
    if (status != 0 && status != kStopped) {
      bool damaged = false;
      for (int part = 0; part < job.parts; ++part)
        damaged |= remove_damaged_parts(job, first + part);
      merged.damaged |= damaged;
      merged.failed |= !damaged;
    }
    if (status != kStopped) continue;
    for (int part = 0; part < job.parts; ++part) {
      UnitRecord record = read_record(job, first + part);
      record.state = State::Waiting;
      write_record(job, first + part, record);
      merged.next_round.push_back(first + part);
    }
  }
  return merged;
}

}  // namespace

int work_task(const Job& job, int task) { return TaskWorker(job, task).run(); }

std::vector<int> missing_tasks(const Job& job) { return tasks_of(job, missing_units(job)); }

std::string submit_tasks(const Job& job, const std::vector<int>& tasks) {
  std::vector<std::string> ids;
  const auto submit = [&](const std::vector<std::string>& words) {
    const ChildResult result = run_child(words, ChildOutput::Capture);
    ids.push_back(parse_job_id(result.out));
    if (result.status == 0 && !ids.back().empty()) return ids.back();
    ids.back() = "scancel";  // the others: nothing would use their results
    std::rotate(ids.begin(), ids.end() - 1, ids.end());
    if (ids.size() > 1) run_child(ids, ChildOutput::Inherit);
    throw std::runtime_error(fmt::format(
        "sbatch failed: {}", result.last_message.empty() ? result.out : result.last_message));
  };
  std::string after;
  if (job.maps) after = submit(maps_submission(job));
  std::string array = submit(render_submission(job, tasks, after));
  const std::string merge = submit(merge_submission(job, array));
  write_durably(job.path("units/submitted"), fmt::format("{} {}\n", array, merge));
  return array;
}

int work_maps(const Job& job, int frame_index) {
  return job.maps ? TaskWorker(job, 0).run_maps(frame_index) : 0;
}

int work_merge(const Job& job, bool may_submit) {
  const MergedFrames merged = merge_complete_frames(job);
  std::vector<int> missing = missing_units(job);
  std::erase_if(missing, [&](int unit) {
    return std::binary_search(merged.next_round.begin(), merged.next_round.end(), unit);
  });
  if (missing.empty() && merged.next_round.empty()) return merged.failed ? 1 : 0;
  print_missing(job, missing);
  const int round = read_round(job);
  const bool retry = !missing.empty() && round < job.retries;
  if (!missing.empty() && !retry)
    fmt::print(stderr, "{} of {} units are missing after {} repetition{}\n", missing.size(),
               job.unit_count(), round, round == 1 ? "" : "s");
  if (!retry && merged.next_round.empty()) return 1;
  if (!may_submit && !merged.damaged) return merged.next_round.empty() ? 1 : kStopped;
  if (retry) write_durably(job.path("units/round"), fmt::format("{}\n", round + 1));
  if (!may_submit) return kStopped;
  const std::vector<int> units = retry ? missing_units(job) : merged.next_round;
  const std::string id = submit_tasks(job, tasks_of(job, units));
  fmt::print(stderr, "{} units are submitted again as job {}\n", units.size(), id);
  return 0;
}

}  // namespace oriel::farm
