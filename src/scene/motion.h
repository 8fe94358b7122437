// SPDX-License-Identifier: Apache-2.0
// Shutter times, and motion paths of instances.
#pragma once

#include <vector>

#include "scene/hierarchy.h"
#include "scene/render_options.h"

namespace oriel::scene {

// Conventions
//   Scene time counts motion intervals. At 0 transforms and points are as written; at 1 they are at
//   the end of their motion vectors and motion transforms. The shutter may open and close at any
//   time; outside the interval the motion is extrapolated. Ray time is 0 at `first` and 1 at
//   `last`.

/// The shutter of an image, in ray time.
struct Shutter {
  bool on = false;  ///< motion blur; off: all ray times are 0 and the rest is unused
  float open = 0, close = 0;
  int first = 0, last = 1;  ///< scene times, which contain the shutter and the interval 0 to 1
  int steps = 1;            ///< linear segments of a transform per interval

  /// Time of a ray; u in [0,1).
  float at(float u) const { return open + u * (close - open); }
  float middle() const { return (open + close) / 2; }
  /// Whether ray times map to the same scene times.
  bool same_span(const Shutter& o) const {
    return on == o.on && first == o.first && last == o.last;
  }
  float scene_time(float ray_time) const {
    return static_cast<float>(first) + ray_time * static_cast<float>(last - first);
  }
};

/// Maximum distance of the shutter in intervals, and maximum number of segments. With these limits
/// a motion path does not exceed the time steps of the ray tracer.
inline constexpr float kFurthestShutter = 4;
inline constexpr int kMaxMotionSteps = 15;

/// Inputs:  out-of-range values are clamped to the limits above.
Shutter shutter_of(const MotionOptions& options);

/// Local-to-world matrices at equal steps of ray time from 0 to 1; empty for a static leaf.
///
/// Model:   each instance of the chain moves separately in its parent: the origin on a straight
///          line, the rotation about a fixed axis at constant speed, the stretch linearly. Matrices
///          between the steps are interpolated linearly, as in the ray tracer. Thus one step moves
///          every point on a straight line; more steps approximate the rotation.
/// Source:  K. Shoemake, T. Duff, "Matrix Animation and Polar Decomposition", 1992.
/// Checked: MotionPath.*
std::vector<Mat4> motion_path(const Leaf& leaf, const Shutter& shutter);

/// The same for one instance: a camera outside the rendered group.
std::vector<Mat4> motion_path(const Instance& instance, const Shutter& shutter);

/// Whether a matrix is singular: its determinant is negligible relative to the product of the
/// lengths of its rows.
bool is_singular(const Imath::M44d& m);

}  // namespace oriel::scene
