// SPDX-License-Identifier: Apache-2.0
// Sampling of a triangle by solid angle.
#pragma once

#include "base/vec.h"

namespace oriel::sampling {

/// A triangle projected to the sphere of directions around a point.
///
/// Model:   uniform in solid angle. Below kSmallestSolidAngle uniform in area, which differs little
///          there; `pdf` is consistent with that.
/// Inputs:  point and corners, scene units.
/// Returns: pdf per solid angle; 0 if the triangle is seen edge-on.
/// Errors:  total.
/// Source:  solid angle: A. Van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", IEEE
///          Trans. Biomed. Eng. 30(2), 1983. Samples: J. Arvo, "Stratified Sampling of Spherical
///          Triangles", SIGGRAPH 1995.
/// Checked: Triangle.* in triangle_test.cpp
class SphericalTriangle {
 public:
  static constexpr float kSmallestSolidAngle = 1e-2f;

  struct Sample {
    Vec3 wi{0};          ///< unit, from the point
    float distance = 0;  ///< scene units
    float pdf = 0;       ///< per solid angle; 0: no sample
  };

  SphericalTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

  bool by_area() const { return by_area_; }
  /// Inputs:  u: uniform in [0,1)^2.
  Sample sample(const Vec2& u) const;
  /// Density of the unit direction `wi`, which hits the triangle at `distance`.
  float pdf(const Vec3& wi, float distance) const;

 private:
  Vec3 a_, b_, c_;  ///< from the point
  Vec3 normal_;     ///< its length is the area
  float length_a_, length_b_, length_c_;
  float solid_angle_ = 0;  ///< unless by area
  bool by_area_;
};

}  // namespace oriel::sampling
