// SPDX-License-Identifier: Apache-2.0
// Unit vectors from angles in degrees.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace oriel::testing {

// Conventions
//   Azimuth turns x to y. Angles are double: they are expectations.

inline double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

/// By the cosine to +z and the azimuth in radians.
inline Vec3 cosine_direction(double cosine, double phi) {
  const double sine = std::sqrt(std::fmax(0.0, 1 - cosine * cosine));
  return Vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
              static_cast<float>(cosine));
}

/// By the angle from +z: directions at a surface.
inline Vec3 polar_direction(double theta_deg, double phi_deg = 0) {
  const double t = radians(theta_deg), p = radians(phi_deg);
  return Vec3(static_cast<float>(std::sin(t) * std::cos(p)),
              static_cast<float>(std::sin(t) * std::sin(p)), static_cast<float>(std::cos(t)));
}

/// By the elevation above the horizon: directions of the sky.
inline Vec3 sky_direction(double elevation_deg, double azimuth_deg = 0) {
  const double e = radians(elevation_deg), a = radians(azimuth_deg);
  return Vec3(static_cast<float>(std::cos(e) * std::cos(a)),
              static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e)));
}

/// By the angle from straight down: directions of a luminaire's profile.
inline Vec3 luminaire_direction(double vertical_deg, double horizontal_deg) {
  const Vec3 up = polar_direction(vertical_deg, horizontal_deg);
  return Vec3(up.x, up.y, -up.z);
}

}  // namespace oriel::testing
