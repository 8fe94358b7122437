// SPDX-License-Identifier: Apache-2.0
// What the frames of a scene file change: placements, cameras, lights, materials and shaders.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace oriel::scene {
class Scene;
}

namespace oriel::app {

/// Collects the placements and elements of frame after frame.
///
/// Model:   the placements of an instance that several groups contain are numbered in their order.
///          Only changes are stored.
/// Checked: SceneDumpTest.FramesMoveInstances, FramesChangeElements
class SceneMotion {
 public:
  /// An element from a frame on.
  struct Version {
    std::size_t frame;
    std::string json;
  };

  /// Adds the placements of the last render statement, and the elements.
  void add_frame(const scene::Scene& scene);
  std::size_t frames() const { return frames_; }
  /// The matrix of each frame, for the nth placement of an instance; empty if all are equal. Frames
  /// before the first that contains it have the first matrix.
  std::vector<Mat4> matrices(const std::string& instance, std::size_t nth) const;
  /// The versions of an element of a list of the dump, in the order of frames; empty if it does not
  /// change.
  std::vector<Version> versions(const std::string& list, const std::string& element) const;
  /// The camera of each frame; empty if all are equal.
  std::vector<std::string> cameras() const;
  /// Whether changes of elements are missing because there are too many.
  bool truncated() const { return versions_bytes_ > kMaxVersionBytes; }

 private:
  static constexpr std::size_t kMaxVersionBytes = std::size_t{1} << 28;

  struct Change {
    std::size_t frame;
    Mat4 matrix;
  };
  void add_elements(const scene::Scene& scene);

  std::map<std::pair<std::string, std::size_t>, std::vector<Change>> changes_;
  std::map<std::pair<std::string, std::string>, std::vector<Version>> versions_;
  std::size_t versions_bytes_ = 0;
  std::vector<std::string> cameras_;
  std::size_t frames_ = 0;
};

}  // namespace oriel::app
