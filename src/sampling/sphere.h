// SPDX-License-Identifier: Apache-2.0
// Uniform solid-angle sampling of a sphere.
#pragma once

#include "base/frame.h"
#include "sampling/warp.h"

namespace oriel::sampling {

/// The cone of directions that hit a sphere, or all directions if the point is inside.
///
/// Inputs:  point, center, radius in the same space.
/// Returns: sample: unit direction; pdf: per solid angle, constant over the cone; 0 for a sphere of
///          radius 0.
/// Errors:  total.
/// Source:  Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations",
///          ACM TOG 15(1), 1996.
/// Checked: SphereCone.SolidAngleIsTheCap, SphereCone.IrradianceIsTheInverseSquare.
class SphereCone {
 public:
  SphereCone(const Vec3& point, const Vec3& center, float radius) {
    const Vec3 axis = center - point;
    const float d2 = dot(axis, axis);
    if (d2 > radius * radius) {
      one_minus_cos_ = one_minus_cos(radius * radius / d2);
      frame_ = Frame(axis * (1 / std::sqrt(d2)));
    } else {
      one_minus_cos_ = 2;
    }
  }

  float solid_angle() const { return kTwoPi * one_minus_cos_; }
  float pdf() const { return one_minus_cos_ > 0 ? 1 / solid_angle() : 0; }
  Vec3 sample(const Vec2& u) const { return frame_.to_world(sample_cone(u, one_minus_cos_)); }

 private:
  Frame frame_;
  float one_minus_cos_ = 0;
};

}  // namespace oriel::sampling
