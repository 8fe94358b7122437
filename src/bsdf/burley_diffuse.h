// SPDX-License-Identifier: Apache-2.0
// Diffuse reflection with a grazing retro-reflection.
#pragma once

#include <optional>

#include "base/math.h"
#include "bsdf/lobe_sample.h"
#include "sampling/warp.h"

namespace oriel::bsdf {

/// Diffuse reflection of Burley.
///
/// Model:   smooth surfaces darken at grazing angles of light and view, rough ones are brighter
///          there. The albedo exceeds 1 for rough surfaces at grazing angles; `scale` divides by
///          the albedo of a view.
/// Inputs:  roughness: 0..1; scale > 0.
/// Source:  Burley, "Physically-Based Shading at Disney", SIGGRAPH 2012 courses, 5.3; "Extending
///          the Disney BRDF", 2015, eq. 4.
/// Checked: BurleyDiffuse.*, the contract suite.
class BurleyDiffuse {
 public:
  explicit BurleyDiffuse(float roughness, float scale = 1) : roughness_(roughness), scale_(scale) {}

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    const float at_view = grazing(wo.z), at_light = grazing(wi.z);
    // 2 roughness cos^2 of the angle between light and half vector.
    const float retro = roughness_ * (1 + dot(wo, wi));
    const float f = (1 - 0.5f * at_view) * (1 - 0.5f * at_light) +
                    retro * (at_view + at_light + at_view * at_light * (retro - 1));
    return f * wi.z * kInvPi * scale_;
  }

  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z > 0 ? sampling::cosine_hemisphere_pdf(wi.z) : 0;
  }

  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    const Vec3 wi = sampling::sample_cosine_hemisphere(u2);
    const float density = sampling::cosine_hemisphere_pdf(wi.z);
    return LobeSample{wi, eval(wo, wi) / density, density, false};
  }

  static float grazing(float cosine) {
    const float left = clamp01(1 - cosine);
    return sqr(sqr(left)) * left;
  }

  /// Directional albedo without scale: a fit, within 3 %.
  static float albedo(float roughness, float cosine) {
    const float facing = 0.9762f + 0.0633f * roughness;
    return facing + grazing(cosine) * (-0.4881f + roughness * (0.97f + 0.09f * roughness));
  }

 private:
  float roughness_, scale_;
};

}  // namespace oriel::bsdf
