// SPDX-License-Identifier: Apache-2.0
// mental ray's Phong and Blinn highlights for the base shaders.
#pragma once

#include <algorithm>

#include "base/math.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// A highlight for light sources only; it is not sampled and not part of an energy balance.
///
/// Model:   a power of the cosine between the mirrored view direction and the light, NOT multiplied
///          by the cosine of the light and not normalised.
/// Returns: eval: cos^exponent / pi, so that the irradiance-like colour of a light times pi times
///          this is mental ray's cos^n times colour.
/// Source:  mi_phong_specular as described in the mental ray manual.
/// Checked: Phong.IsTheBareCosinePower.
struct PhongHighlight {
  float exponent = 1;

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    const float c = wo.z * wi.z - wo.x * wi.x - wo.y * wi.y;
    return c > 0 ? math::pow(c, exponent) * kInvPi : 0;
  }
};

/// A power of the cosine between the half vector and the normal, not normalised.
/// Source:  Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977.
/// Checked: BlinnPhong.IsThePowerOfTheHalfVectorsCosine.
inline float blinn_phong(const Vec3& wo, const Vec3& wi, float exponent) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  return math::pow(std::max(0.0f, normalize(wo + wi).z), exponent);
}

}  // namespace oriel::bsdf
