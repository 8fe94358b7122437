// SPDX-License-Identifier: Apache-2.0
// A job: a packed scene, what is rendered of it, and the state of its units.
#pragma once

#include <string>
#include <vector>

namespace oriel::farm {

/// Resources that a job requests. Empty texts and zeros: the defaults of the workload manager.
struct JobResources {
  int nodes = 0;  ///< tasks that run at the same time
  int cpus = 0;   ///< of a task; 0: whole nodes
  std::string time, partition, account, memory;
  int lead = 120;                    ///< seconds between the signal and the time limit
  std::vector<std::string> further;  ///< words for sbatch
};

/// A unit is one part of one frame; a task renders `chunk` units one after the other.
struct Job {
  std::string folder;   ///< absolute
  std::string name;     ///< plain, for lists of jobs
  std::string program;  ///< absolute path of oriel
  std::string scene;    ///< name of the scene in the folder "scene"
  std::string output;   ///< absolute path of the pictures; # stands for the frame
  std::vector<int> frames = {1};
  std::vector<std::string> outputs;  ///< absolute path of the picture of each frame
  int parts = 1;                     ///< of each frame
  int chunk = 1;
  int retries = 2;                       ///< times that missing units are submitted again
  bool libraries = false, code = false;  ///< of the scene: see PackReport
  int mpi = 0;         ///< nodes that render each picture together; 0: parts are independent
  bool maps = false;   ///< maps of indirect light are computed once for all parts of a frame
  std::string stage;   ///< folder on the nodes to which the scene is copied; empty: none
  double stagger = 0;  ///< seconds between the first reads of two tasks
  std::vector<std::string> render;  ///< further words of oriel render
  JobResources resources;

  struct Unit {
    int frame = 1, part = 1;
  };
  int unit_count() const { return static_cast<int>(frames.size()) * parts; }
  int task_count() const { return (unit_count() + chunk - 1) / chunk; }
  Unit unit(int index) const {
    return {frames[static_cast<std::size_t>(index / parts)], index % parts + 1};
  }
  /// Indices of the units of a task.
  std::vector<int> units_of_task(int task) const;
  /// "part 3 of 16", "frame 7", "frame 7, part 3 of 16".
  std::string unit_name(int index) const;

  std::string path(const std::string& file) const { return folder + "/" + file; }
  const std::string& output_of(int frame_index) const {
    return outputs[static_cast<std::size_t>(frame_index)];
  }
  std::string part_output() const { return path("parts/frame-####.exr"); }  ///< -o of all parts
  /// What the render of a part writes; `eye`: "" or, of stereo cameras, "_left" or "_right".
  std::string part_file(int frame, int part, const std::string& eye = "") const;
  /// The state of a picture that several nodes render together.
  std::string checkpoint_file(int frame) const;
  std::string maps_folder() const { return path("maps"); }
  std::string maps_file(int frame) const;
  std::string record_file(int unit) const;
};

/// The state of a unit, as its last task recorded it.
struct UnitRecord {
  enum class State : unsigned char { Waiting, Running, Stopped, Done, Failed };
  State state = State::Waiting;
  int attempts = 0;
  double seconds = 0;  ///< of the last attempt
  std::string node;
  std::string task;     ///< id of the workload manager
  std::string message;  ///< the last line of a failed render
};

/// Writes job.json. Errors: std::runtime_error.
void write_job(const Job& job);
/// Reads the job of a folder. Errors: std::runtime_error that names the file and the fault.
/// Checked: FarmJob.*
Job read_job(const std::string& folder);

void write_record(const Job& job, int unit, const UnitRecord& record);
/// Waiting if there is no record or it is damaged.
UnitRecord read_record(const Job& job, int unit);

/// The files of a part that exist: one, or one for each eye.
std::vector<std::string> part_files(const Job& job, int unit);

/// Whether the picture of a frame exists, or that of its left eye.
bool has_picture(const Job& job, int frame_index);

/// Whether the unit is recorded as done and its part, or the picture of its frame, exists.
bool is_done(const Job& job, int unit);

/// The largest chunk size of tasks such that an array has at most `max_tasks`.
int chunk_for(int units, int max_tasks);

}  // namespace oriel::farm
