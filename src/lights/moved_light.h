// SPDX-License-Identifier: Apache-2.0
// Where a light that moves is at a time.
#pragma once

#include <cmath>

#include "geom/motion.h"
#include "geom/surface.h"
#include "lights/sample_light.h"

namespace oriel {

/// Whether a light stands at that time as it is written.
inline bool is_at_rest(const Light& light, float time) {
  return light.path.empty() || time == kAsWritten;
}

/// A light that moves, at a time: what it lights is taken to where the light stands as written, and
/// what is found there back.
///
/// Model:   any matrix: shapes that are stretched keep their radiance. Turned lights have their
///          shader's answer as it is.
/// Checked: MotionBlur.*, MovingLights.*, MovingPortals.* in tests/analytic
class MovedLight {
 public:
  MovedLight(const Light& light, float time)
      : there_(geom::matrix_at(light.path, time)), back_(geom::inverse_of(there_)) {}

  Vec3 place_at_rest(const Vec3& place) const { return transform_point(place, back_); }
  Vec3 place(const Vec3& at_rest) const { return transform_point(at_rest, there_); }
  /// As long as they then are.
  Vec3 way_at_rest(const Vec3& way) const { return transform_vector(way, back_); }
  Vec3 way(const Vec3& at_rest) const { return transform_vector(at_rest, there_); }
  /// Unit.
  Vec3 direction_at_rest(const Vec3& direction) const { return normalize(way_at_rest(direction)); }
  Vec3 direction(const Vec3& at_rest) const { return normalize(way(at_rest)); }
  Vec3 normal_at_rest(const Vec3& normal) const {
    return normalize(transform_normal(normal, there_));
  }

  /// Factor of a length along that unit direction at rest.
  float stretch(const Vec3& at_rest) const { return length(way(at_rest)); }
  /// Factor of a density per solid angle around it.
  float crowding(const Vec3& at_rest) const {
    const float s = stretch(at_rest);
    return s * s * s / volume();
  }
  /// Factor of the flux around it through the shape, at the same radiance: of the area as
  /// seen from there times the solid angle.
  float flux(const Vec3& at_rest) const {
    const float s = stretch(at_rest);
    return volume() / s / crowding(at_rest);
  }

 private:
  float volume() const { return static_cast<float>(std::abs(geom::determinant3(there_))); }

  Mat4 there_, back_;
};

}  // namespace oriel
