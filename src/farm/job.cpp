// SPDX-License-Identifier: Apache-2.0
#include "farm/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/durable_file.h"
#include "base/file_access.h"
#include "prepare/stereo.h"

namespace oriel::farm {

using State = UnitRecord::State;

// The files of a job. An unknown state is the first one.
NLOHMANN_JSON_SERIALIZE_ENUM(UnitRecord::State, {{State::Waiting, "waiting"},
                                                 {State::Running, "running"},
                                                 {State::Stopped, "stopped"},
                                                 {State::Done, "done"},
                                                 {State::Failed, "failed"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UnitRecord, state, attempts, seconds, node, task, message)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(JobResources, nodes, cpus, time, partition, account, memory,
                                   lead, further)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Job, name, program, scene, output, frames, outputs, parts, chunk,
                                   retries, libraries, code, mpi, maps, stage, stagger, render,
                                   resources)

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMaxJobText = std::size_t{1} << 26;
constexpr int kMaxUnits = 10'000'000;

std::string json_text(const json& value) {
  return value.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

json read_json(const std::string& path) {
  OpenFile file = open_regular(path);
  if (!file) throw std::runtime_error(fmt::format("cannot read '{}': {}", path, file.reason()));
  json value = json::parse(file.read(kMaxJobText), nullptr, false);
  if (!value.is_object()) throw std::runtime_error(fmt::format("'{}' is damaged", path));
  return value;
}

void check_job(const Job& job, const std::string& path) {
  const bool bad = job.frames.empty() || job.frames.size() != job.outputs.size() || job.parts < 1 ||
                   job.chunk < 1 || job.retries < 0 || job.mpi < 0 ||
                   job.frames.size() > static_cast<std::size_t>(kMaxUnits / job.parts) ||
                   std::any_of(job.frames.begin(), job.frames.end(), [](int f) { return f < 1; });
  if (bad) throw std::runtime_error(fmt::format("'{}' is damaged", path));
}

}  // namespace

std::vector<int> Job::units_of_task(int task) const {
  std::vector<int> units;
  for (int i = task * chunk; i < std::min((task + 1) * chunk, unit_count()); ++i)
    units.push_back(i);
  return units;
}

std::string Job::unit_name(int index) const {
  const Unit u = unit(index);
  const std::string part = parts > 1 ? fmt::format("part {} of {}", u.part, parts) : "";
  if (frames.size() == 1 && parts > 1) return part;
  return fmt::format("frame {}{}{}", u.frame, part.empty() ? "" : ", ", part);
}

std::string Job::part_file(int frame, int part, const std::string& eye) const {
  return path(fmt::format("parts/frame-{:04}{}.part-{}-of-{}", frame, eye, part, parts));
}

std::string Job::checkpoint_file(int frame) const {
  return path(fmt::format("parts/frame-{:04}.checkpoint", frame));
}

std::string Job::maps_file(int frame) const {
  return fmt::format("{}/frame-{:04}.maps", maps_folder(), frame);
}

std::string Job::record_file(int index) const {
  const Unit u = unit(index);
  return path(fmt::format("units/frame-{:04}.part-{}.json", u.frame, u.part));
}

void write_job(const Job& job) { write_durably(job.path("job.json"), json_text(job)); }

Job read_job(const std::string& folder) {
  std::error_code error;
  Job job;
  job.folder = fs::weakly_canonical(fs::absolute(folder, error), error).string();
  const std::string path = job.path("job.json");
  const json from = read_json(path);
  try {
    from.get_to(job);
  } catch (const json::exception& e) {
    throw std::runtime_error(fmt::format("'{}' is damaged: {}", path, e.what()));
  }
  check_job(job, path);
  return job;
}

void write_record(const Job& job, int unit, const UnitRecord& record) {
  write_durably(job.record_file(unit), json_text(record));
}

UnitRecord read_record(const Job& job, int unit) {
  try {
    return read_json(job.record_file(unit)).get<UnitRecord>();
  } catch (const std::exception&) {
    return {};  // of an older version, or half copied
  }
}

bool has_picture(const Job& job, int frame_index) {
  std::error_code error;
  const std::string& output = job.output_of(frame_index);
  return fs::is_regular_file(output, error) ||
         fs::is_regular_file(eye_path(output, Eye::Left), error);
}

std::vector<std::string> part_files(const Job& job, int unit) {
  const Job::Unit u = job.unit(unit);
  std::vector<std::string> files;
  std::error_code error;
  for (const char* eye : {"", "_left", "_right"})
    if (std::string file = job.part_file(u.frame, u.part, eye); fs::is_regular_file(file, error))
      files.push_back(std::move(file));
  return files;
}

bool is_done(const Job& job, int unit) {
  return read_record(job, unit).state == State::Done &&
         (!part_files(job, unit).empty() || has_picture(job, unit / job.parts));
}

int chunk_for(int units, int max_tasks) {
  const int tasks = std::max(max_tasks, 1);
  return std::max(1, (units + tasks - 1) / tasks);
}

}  // namespace oriel::farm
