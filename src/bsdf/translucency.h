// SPDX-License-Identifier: Apache-2.0
// Diffuse (Lambert) transmission.
#pragma once

#include <optional>

#include "bsdf/lobe_sample.h"
#include "sampling/warp.h"

namespace oriel::bsdf {

/// White Lambert transmission to the side away from the viewer. Reciprocal.
/// Checked: Contract/LobeContract, Translucency.IsLambertOnTheOtherSide.
struct Translucency {
  float eval(const Vec3& wo, const Vec3& wi) const { return pdf(wo, wi); }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z > 0 ? sampling::cosine_hemisphere_pdf(-wi.z) : 0;
  }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    Vec3 wi = sampling::sample_cosine_hemisphere(u2);
    wi.z = -wi.z;
    return LobeSample{wi, 1, pdf(wo, wi), false};
  }
};

}  // namespace oriel::bsdf
