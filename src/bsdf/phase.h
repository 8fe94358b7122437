// SPDX-License-Identifier: Apache-2.0
// Scattering in a homogeneous medium: Schlick's phase function and free-path sampling.
#pragma once

#include <cmath>

#include "base/math.h"
#include "base/vec.h"
#include "sampling/warp.h"

namespace oriel::bsdf {

/// Schlick's phase function, in units of the density per solid angle.
///
/// Inputs:  cosine: between the propagation directions before and after scattering; directionality:
///          -1 backward ... 0 isotropic ... 1 forward, clamped to +-0.9999.
/// Model:   (1 - k^2) / (4 pi (1 - k cosine)^2).
/// Source:  Blasi, Le Saec, Schlick, "A Rendering Algorithm for Discrete Volume Density Objects",
///          Eurographics 1993, with the sign that makes k > 0 scatter forward.
/// Checked: SchlickPhase.*
struct SchlickPhase {
  float k;
  explicit SchlickPhase(float directionality) : k(clamp(directionality, -0.9999f, 0.9999f)) {}

  float eval(float cosine) const { return (1 - k * k) / (4 * kPi * sqr(1 - k * cosine)); }
  /// Samples the propagation direction after scattering in the frame whose z is the direction
  /// before; the density is eval().
  Vec3 sample(const Vec2& u) const {
    const float c = clamp((2 * u.x - 1 + k) / (1 + k * (2 * u.x - 1)), -1, 1);
    const float s = std::sqrt(1 - c * c);
    const sampling::SinCos turn = sampling::sincos_turns(u.y);
    return Vec3(s * turn.cos, s * turn.sin, c);
  }
};

/// Samples the distance to the next event in a medium with this extinction (per unit of length, >
/// 0).
/// Checked: FreePath.IsExponential
inline float sample_free_path(float u, float extinction) { return -math::log1p(-u) / extinction; }

}  // namespace oriel::bsdf
