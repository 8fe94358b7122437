// SPDX-License-Identifier: Apache-2.0
// The placement of a moving light at a time.
#pragma once

#include <cmath>

#include "geom/motion.h"
#include "geom/surface.h"
#include "lights/sample_light.h"

namespace oriel {

/// Whether a light is at its written placement at that time.
inline bool is_at_rest(const Light& light, float time) {
  return light.path.empty() || time == kAsWritten;
}

/// A moving light at a time: transforms points to the frame of its written placement, and results
/// back.
///
/// Model:   any matrix; scaled shapes keep their radiance. The shader's result is not transformed.
/// Checked: MotionBlur.*, MovingLights.*, MovingPortals.* in tests/analytic
class MovedLight {
 public:
  MovedLight(const Light& light, float time)
      : there_(geom::matrix_at(light.path, time)), back_(geom::inverse_of(there_)) {}

  Vec3 place_at_rest(const Vec3& place) const { return transform_point(place, back_); }
  Vec3 place(const Vec3& at_rest) const { return transform_point(at_rest, there_); }
  /// With the transformed length.
  Vec3 way_at_rest(const Vec3& way) const { return transform_vector(way, back_); }
  Vec3 way(const Vec3& at_rest) const { return transform_vector(at_rest, there_); }
  /// Unit.
  Vec3 direction_at_rest(const Vec3& direction) const { return normalize(way_at_rest(direction)); }
  Vec3 direction(const Vec3& at_rest) const { return normalize(way(at_rest)); }
  Vec3 normal_at_rest(const Vec3& normal) const {
    return normalize(transform_normal(normal, there_));
  }

  /// Factor of lengths along that unit direction of the written placement.
  float stretch(const Vec3& at_rest) const { return length(way(at_rest)); }
  /// Factor of densities per solid angle around it.
  float crowding(const Vec3& at_rest) const {
    const float s = stretch(at_rest);
    return s * s * s / volume();
  }
  /// Factor of the flux through the shape around it at equal radiance: of projected area times
  /// solid angle.
  float flux(const Vec3& at_rest) const {
    const float s = stretch(at_rest);
    return volume() / s / crowding(at_rest);
  }

 private:
  float volume() const { return static_cast<float>(std::abs(geom::determinant3(there_))); }

  Mat4 there_, back_;
};

}  // namespace oriel
