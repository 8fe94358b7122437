// SPDX-License-Identifier: Apache-2.0
// When the shutter is open, and where instances stand meanwhile.
#pragma once

#include <vector>

#include "scene/hierarchy.h"
#include "scene/render_options.h"

namespace oriel::scene {

// Conventions
//   Scene time counts motion intervals: at 0 everything stands as written, at 1 it stands where
//   motion vectors and motion transforms lead; the shutter may open and close anywhere, and beyond
//   the interval motion goes on as it ends. Ray time is 0 at `first` and 1 at `last`.

/// The shutter of a picture, in ray time.
struct Shutter {
  bool on = false;  ///< things may move; else all rays have time 0 and nothing else counts
  float open = 0, close = 0;
  int first = 0, last = 1;  ///< scene times, the interval 0 to 1 and the shutter within
  int steps = 1;            ///< straight pieces of a transform's way in one interval

  /// Time of a ray; u in [0,1).
  float at(float u) const { return open + u * (close - open); }
  float middle() const { return (open + close) / 2; }
  /// Whether ray times mean the same.
  bool same_span(const Shutter& o) const {
    return on == o.on && first == o.first && last == o.last;
  }
  float scene_time(float ray_time) const {
    return static_cast<float>(first) + ray_time * static_cast<float>(last - first);
  }
};

/// Furthest a shutter reaches, in intervals, and most pieces of a way: with these no way has more
/// points than the ray tracer takes.
inline constexpr float kFurthestShutter = 4;
inline constexpr int kMaxMotionSteps = 15;

/// Inputs:  values out of range are clamped to the limits above.
Shutter shutter_of(const MotionOptions& options);

/// Local to world at equal steps of ray time from 0 to 1; empty for what stands still.
///
/// Model:   each instance of the chain moves on its own within its parent: the origin on a straight
///          line, the rotation about a fixed axis at constant speed, the stretch linearly. Between
///          the steps matrices interpolate linearly, as the ray tracer has it, so one step is a
///          straight way of every point, and more steps follow the rotation.
/// Source:  K. Shoemake, T. Duff, "Matrix Animation and Polar Decomposition", 1992.
/// Checked: MotionPath.*
std::vector<Mat4> motion_path(const Leaf& leaf, const Shutter& shutter);

/// A camera outside of the rendered group: the same for one instance.
std::vector<Mat4> motion_path(const Instance& instance, const Shutter& shutter);

/// Whether a matrix squashes space: its volume is negligible relative to the product of its row
/// lengths.
bool is_singular(const Imath::M44d& m);

}  // namespace oriel::scene
