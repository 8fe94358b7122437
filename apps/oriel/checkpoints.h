// SPDX-License-Identifier: Apache-2.0
// Checkpoints of oriel render: when they are written, and which render they belong to.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "base/checkpoint_file.h"
#include "base/diagnostic.h"
#include "prepare/stereo.h"
#include "render/session.h"

namespace oriel::app {

/// The values of --checkpoint and --resume.
struct CheckpointRequest {
  std::string file;               ///< to write; empty = none
  std::optional<double> seconds;  ///< interval
  std::string resume;             ///< to read; empty = none
  bool may_start = false;         ///< without the file to read, the render starts
  bool starts_quietly = false;    ///< no note about that
};

/// Inputs:  checkpoint: "FILE" or "FILE,every SECONDS"; resume: "FILE", which is also written
///          unless `checkpoint` names another one.
/// Errors:  UsageError; UserError if the file exists and may not be replaced.
CheckpointRequest checkpoint_request(const std::string& checkpoint, const std::string& resume);

/// Removes ",every SECONDS" from the end of a value of --checkpoint. Returns: the seconds.
/// Errors:  UsageError.
std::optional<double> take_checkpoint_seconds(std::string& checkpoint);

/// A picture of a render: one eye of one frame.
struct RenderPlace {
  int frame = 1;
  Eye eye = Eye::Middle;
  bool operator==(const RenderPlace&) const = default;
  bool operator<(const RenderPlace& o) const {
    return frame != o.frame ? frame < o.frame : eye < o.eye;
  }
};

/// Labels that identify the render of a session: `options`, settings and files.
CheckpointLabels labels_of_picture(const std::string& scene, const CheckpointLabels& options,
                                   const RenderSession& session);
/// Removes the labels that say where in the render a file is.
void erase_notes(CheckpointLabels& labels);
/// The place of a picture file's labels; nothing if they are damaged.
std::optional<RenderPlace> place_of_labels(const CheckpointLabels& labels);

/// Writes and reads the checkpoints of a process.
///
/// Model:   one file. While a picture is rendered, it contains the state of the picture; after a
///          picture of an animation, only which one that was. It is removed when the render is
///          complete. Labels identify the render: program, options and files that decide the
///          picture.
/// Errors:  OR-RN-073: a checkpoint cannot be written: a warning, and it is tried again after the
///          next interval; at the end of a render an error. OR-RN-074: there is nothing to resume,
///          the render starts. UserError if a checkpoint cannot be used; it is not changed.
/// Checked: Resume.*, Checkpoints.* in tests/faults
class Checkpoints {
 public:
  /// Opens the file to resume. `scene` is the path of the scene; `options`: labels of the command
  /// line.
  Checkpoints(const CheckpointRequest& request, const std::string& scene,
              const CheckpointLabels& options, Diagnostics& diagnostics);

  bool writes() const { return !request_.file.empty(); }
  /// Further labels of the files, whose names begin with "at ".
  void set_notes(CheckpointLabels notes) { notes_ = std::move(notes); }
  /// Labels of the file to resume before begin(); empty if there is none.
  CheckpointLabels resumed_labels() const {
    return resumed_ ? resumed_->labels() : CheckpointLabels();
  }
  /// Labels that identify the render, after begin().
  const CheckpointLabels& picture_labels() const { return picture_labels_; }
  /// Whether the earlier render finished this picture.
  bool is_finished(RenderPlace place) const;
  /// Before a picture is rendered: restores its state if the checkpoint contains it.
  void begin(RenderPlace place, RenderSession& session);
  /// Whether it is time to write the state of the picture. From any thread.
  bool is_due() const;
  /// Writes the state while the session is paused, or with `at_end` after it ended. Returns false
  /// if this fails, which is reported.
  bool write(RenderSession& session, bool at_end = false);
  /// Whether the file exists and contains the last state that was to be written.
  bool can_resume() const;
  /// Duration of the last write.
  double write_seconds() const { return write_seconds_; }
  /// After a picture of an animation that is not the last one.
  void end_picture(RenderPlace place);
  /// After all pictures.
  void remove();

 private:
  using Clock = std::chrono::steady_clock;
  CheckpointLabels labels_of(RenderPlace place, bool finished) const;
  bool write_file(const CheckpointLabels& labels, RenderSession* session, bool at_end);
  [[noreturn]] void refuse(const std::string& why, const std::string& what_to_do) const;
  void require_same(const CheckpointLabels& here, bool of_finished) const;
  void schedule();

  CheckpointRequest request_;
  std::string scene_, folder_;  ///< of the scene
  CheckpointLabels options_, notes_;
  Diagnostics& diagnostics_;
  std::unique_ptr<CheckpointReader> resumed_;  ///< until its picture begins
  RenderPlace resumed_place_, place_;
  bool resumed_is_finished_ = false;
  CheckpointLabels picture_labels_;  ///< of the picture that is rendered
  double write_seconds_ = 0;
  bool write_failed_ = false;  ///< the last one
  std::atomic<Clock::time_point> next_;
};

}  // namespace oriel::app
