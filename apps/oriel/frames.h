// SPDX-License-Identifier: Apache-2.0
// Frames of an animation: which are rendered, and where their pictures go.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/camera_output.h"
#include "prepare/stereo.h"

namespace oriel::app {

/// Frames as arguments name them, counted from 1: "1..20", "3,7,12..15", "8.." to the end.
class FrameList {
 public:
  FrameList() = default;  ///< all
  /// Errors: UsageError.
  explicit FrameList(const std::string& text);
  bool holds(int frame) const;
  /// Whether a frame at or after that one is wanted.
  bool goes_on_from(int frame) const;

 private:
  std::vector<std::pair<int, int>> ranges_;  // both ends included
};

/// The path of a frame: its number with as many digits as there are # in the name, "out.####.exr";
/// without any "out.exr", from the second frame on "out.0002.exr".
std::string frame_path(const std::string& path, int frame);

/// Files of the frames so far. A camera that names the same file for several frames gets a number
/// in it from the second on.
class FrameFiles {
 public:
  /// Every frame passes here, rendered or not; again when its camera was edited. `outputs`: of the
  /// command line, which stand for those of the camera; `otherwise`: where nothing names a file.
  void begin(int frame, const std::vector<std::string>& outputs, const scene::Camera* camera,
             const OutputRoots& roots, const std::string& otherwise);
  /// The path of a camera's file in this frame.
  std::string path_of(const std::string& path) const;
  /// The files of the frame, of both eyes where the camera has two.
  std::vector<std::string> all() const;
  /// Whether all of them are there.
  bool all_exist() const;

 private:
  int frame_ = 0;
  std::vector<std::string> expected_;  // without names of eyes
  std::vector<Eye> eyes_;
  std::set<std::string> known_, taken_;  // of cameras: of all frames, of those before this one
};

}  // namespace oriel::app
