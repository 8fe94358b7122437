// SPDX-License-Identifier: Apache-2.0
// Directions toward a sphere seen from a point, uniform in solid angle.
#pragma once

#include "base/frame.h"
#include "sampling/warp.h"

namespace oriel::sampling {

/// The cone of directions that meet a sphere, or the whole sphere of directions from inside it.
///
/// Inputs:  point, center, radius in one space, scene units.
/// Returns: sample: unit direction; pdf: per solid angle, the same for every direction that meets
///          the sphere, 0 for a sphere without size.
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
