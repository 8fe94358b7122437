// SPDX-License-Identifier: Apache-2.0
#include "farm/job_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace oriel::farm {
namespace {

using State = UnitRecord::State;

constexpr std::size_t kMaxFailures = 20;  // further ones are counted

}  // namespace

JobStatus job_status(const Job& job, const std::optional<std::vector<SlurmTask>>& tasks) {
  std::set<int> active;
  if (tasks)
    for (const SlurmTask& task : *tasks)
      if (task.task >= 0 && (task.state == "RUNNING" || task.state == "COMPLETING"))
        active.insert(task.task);
  JobStatus status;
  status.units = job.unit_count();
  status.frames = static_cast<int>(job.frames.size());
  std::vector<int> done_parts(job.frames.size());
  double seconds = 0;
  for (int i = 0; i < status.units; ++i) {
    UnitRecord record = read_record(job, i);
    if (record.state == State::Done && !is_done(job, i)) record.state = State::Waiting;
    if (record.state == State::Running && tasks && !active.contains(i / job.chunk))
      record.state = State::Waiting;
    switch (record.state) {
      case State::Waiting:
        ++status.waiting;
        break;
      case State::Running:
        ++status.running;
        break;
      case State::Stopped:
        ++status.stopped;
        break;
      case State::Done:
        ++status.done;
        seconds += record.seconds;
        ++done_parts[static_cast<std::size_t>(i / job.parts)];
        break;
      case State::Failed:
        ++status.failed;
        status.failures.push_back({i, record.attempts, record.message});
        break;
    }
  }
  status.frames_done =
      static_cast<int>(std::count(done_parts.begin(), done_parts.end(), job.parts));
  if (status.done == 0) return status;
  status.mean_seconds = seconds / status.done;
  const int left = status.running + status.waiting + status.stopped;
  const int limit = job.resources.nodes > 0 ? job.resources.nodes : job.task_count();
  const int at_once = std::max(1, status.running > 0 ? status.running : std::min(limit, left));
  // Rounds of units, half of those that run are behind them.
  const double rounds = std::ceil(double(left) / at_once) - (status.running > 0 ? 0.5 : 0);
  status.seconds_left = left > 0 ? std::max(0.0, rounds) * status.mean_seconds : 0;
  return status;
}

std::string clock_text(double seconds) {
  const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string status_text(const Job& job, const JobStatus& s) {
  const bool parts = job.parts > 1;
  std::string text = fmt::format("{}: {} of {} {} done", job.name, s.done, s.units,
                                 parts          ? "parts"
                                 : s.units == 1 ? "frame"
                                                : "frames");
  if (parts && s.frames > 1) text += fmt::format(" ({} of {} frames)", s.frames_done, s.frames);
  for (const auto& [count, word] : {std::pair(s.running, "running"),
                                    {s.stopped, "stopped"},
                                    {s.waiting, "waiting"},
                                    {s.failed, "failed"}})
    if (count > 0) text += fmt::format(", {} {}", count, word);
  if (s.seconds_left && *s.seconds_left > 0)
    text += fmt::format("; about {} left", clock_text(*s.seconds_left));
  text += '\n';
  for (std::size_t i = 0; i < s.failures.size() && i < kMaxFailures; ++i) {
    const JobStatus::Failure& f = s.failures[i];
    text +=
        fmt::format("{} failed (attempt {}): {}\n", job.unit_name(f.unit), f.attempts, f.message);
  }
  if (s.failures.size() > kMaxFailures)
    text += fmt::format("{} further failures\n", s.failures.size() - kMaxFailures);
  return text;
}

}  // namespace oriel::farm
