// SPDX-License-Identifier: Apache-2.0
// The sphere of directions as a unit square, without trigonometry.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace oriel::sampling {

// Conventions
//   A direction is projected to the octahedron |x| + |y| + |z| = 1; its upper half fills the square
//   whose corners are the middles of the edges of [0,1]^2, and the lower half is folded outward.
//   Source: Praun, Hoppe, "Spherical Parametrization and Remeshing", SIGGRAPH 2003.
//   Checked: Octahedral.*

/// The point of [0,1]^2 of a unit direction.
inline Vec2 octahedral_uv(const Vec3& d) {
  const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  float x = d.x * scale, y = d.y * scale;
  if (d.z < 0) {
    const float folded = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded;
  }
  return Vec2(0.5f * x + 0.5f, 0.5f * y + 0.5f);
}

/// The unit direction of a point of [0,1]^2.
inline Vec3 octahedral_direction(const Vec2& uv) {
  float x = 2 * uv.x - 1, y = 2 * uv.y - 1;
  const float z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const float folded = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded;
  }
  return normalize(Vec3(x, y, z));
}

/// Solid angle for each unit of area of the square at a unit direction: 4 to 4 * 3^(3/2).
inline float octahedral_solid_angle(const Vec3& d) {
  const float s = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  return 4 * s * s * s;
}

}  // namespace oriel::sampling
