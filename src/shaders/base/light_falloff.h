// SPDX-License-Identifier: Apache-2.0
// Functions shared by light shaders: distance falloff and spot cones.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/light.h"

namespace oriel {

/// 1 / distance^exponent with the light's exponent; 1 for infinite lights.
inline float distance_decay(const Light& light, float distance) {
  if (light.shape == LightShape::Directional) return 1;
  const float d = std::max(distance, 1e-6f);
  return light.exponent == 2 ? 1 / sqr(d) : math::pow(d, -light.exponent);
}

/// Whether the direction is within the outer cone of a spot.
inline bool in_spread(const Light& light, const Vec3& direction) {
  return light.spread < -1 || dot(direction, light.direction) > light.spread;
}

/// 1 inside the inner cone, 0 outside the outer one, linear in the cosine between.
inline float spot_share(const Light& light, const Vec3& direction, float cone) {
  if (light.spread < -1) return 1;
  const float cosine = dot(direction, light.direction);
  if (cosine <= light.spread) return 0;
  if (cosine >= cone || cone <= light.spread) return 1;
  return (cosine - light.spread) / (cone - light.spread);
}

}  // namespace oriel
