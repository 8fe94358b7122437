// SPDX-License-Identifier: Apache-2.0
// mental ray's Phong highlight, for the base shaders that use it.
#pragma once

#include <algorithm>

#include "base/math.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// A highlight of lights only: it is neither sampled nor part of any energy budget.
///
/// Model:   the cosine between the mirrored viewer and the light to a power, NOT multiplied by the
///          light's cosine and not normalised.
/// Returns: eval: cos^exponent / pi, so that a light's irradiance-like colour times pi times this
///          is mental ray's cos^n times colour.
/// Source:  mental ray's mi_phong_specular as its manual describes it.
/// Checked: Phong.IsTheBareCosinePower.
struct PhongHighlight {
  float exponent = 1;

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    const float c = wo.z * wi.z - wo.x * wi.x - wo.y * wi.y;
    return c > 0 ? math::pow(c, exponent) * kInvPi : 0;
  }
};

/// The cosine between the half vector and the normal to a power, not normalised.
/// Source:  Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977.
/// Checked: BlinnPhong.IsThePowerOfTheHalfVectorsCosine.
inline float blinn_phong(const Vec3& wo, const Vec3& wi, float exponent) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  return math::pow(std::max(0.0f, normalize(wo + wi).z), exponent);
}

}  // namespace oriel::bsdf
