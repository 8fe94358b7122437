// SPDX-License-Identifier: Apache-2.0
// Where the frames of a scene file place its instances.
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

/// Collects the placements of frame after frame.
///
/// Model:   the placements of an instance that several groups contain are numbered in their order.
///          Only changes are stored.
/// Checked: SceneDumpTest.FramesMoveInstances
class SceneMotion {
 public:
  /// Adds the placements of the last render statement.
  void add_frame(const scene::Scene& scene);
  std::size_t frames() const { return frames_; }
  /// The matrix of each frame, for the nth placement of an instance; empty if all are equal. Frames
  /// before the first that contains it have the first matrix.
  std::vector<Mat4> matrices(const std::string& instance, std::size_t nth) const;

 private:
  struct Change {
    std::size_t frame;
    Mat4 matrix;
  };
  std::map<std::pair<std::string, std::size_t>, std::vector<Change>> changes_;
  std::size_t frames_ = 0;
};

}  // namespace oriel::app
