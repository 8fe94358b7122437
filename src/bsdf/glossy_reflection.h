// SPDX-License-Identifier: Apache-2.0
// Glossy reflection, and blurred transmission of a thin sheet.
#pragma once

#include <optional>

#include "base/assert.h"
#include "bsdf/ggx.h"
#include "bsdf/ggx_albedo.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// White glossy reflection without Fresnel; the caller applies a weight that depends on the view
/// angle.
///
/// Model:   single scattering on GGX, divided by its directional albedo, so that the total
///          reflectance is 1 for every roughness. The division depends on the view direction, so
///          the lobe is not reciprocal.
/// Inputs:  ax, ay: from gloss.h, not a mirror.
/// Source:  Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007;
///          Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", 2019.
/// Checked: GlossyReflection.FurnaceIsWhite and the contract suite.
class GlossyReflection {
 public:
  GlossyReflection(float ax, float ay) : ggx_{ax, ay} { ORIEL_ASSERT(ax > 0 && ay > 0); }
  /// Lobe for one view direction: the albedo is looked up once, and eval, pdf and sample must use
  /// the same wo. This halves the cost if a point is lit by several lights.
  GlossyReflection(float ax, float ay, float inverse_albedo)
      : ggx_{ax, ay}, inverse_albedo_(inverse_albedo) {}
  GlossyReflection(float ax, float ay, const Vec3& wo)
      : ggx_{ax, ay}, inverse_albedo_(wo.z > 0 ? 1 / ggx_albedo(ax, ay, wo) : 1) {}

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    // D G2 / (4 wo.z) with G2 expanded.
    const float shadowed = ggx_.stretched(wo) * wi.z + ggx_.stretched(wi) * wo.z;
    return 0.5f * ggx_.d(normalize(wo + wi)) * wi.z / shadowed * inverse_albedo(wo);
  }

  float pdf(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    return 0.5f * ggx_.d(normalize(wo + wi)) / (wo.z + ggx_.stretched(wo));
  }

  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    const Vec3 h = ggx_.sample_visible(wo, u2);
    const Vec3 wi = reflect(wo, h);
    if (wi.z <= 0) return std::nullopt;
    const float so = ggx_.stretched(wo), si = ggx_.stretched(wi);
    const float passed = wi.z * (wo.z + so) / (so * wi.z + si * wo.z);  // G2 / G1(wo)
    return LobeSample{wi, passed * inverse_albedo(wo), 0.5f * ggx_.d(h) / (wo.z + so), false};
  }

 private:
  float inverse_albedo(const Vec3& wo) const {
    return inverse_albedo_ > 0 ? inverse_albedo_ : 1 / ggx_albedo(ggx_.ax, ggx_.ay, wo);
  }

  Ggx ggx_;
  float inverse_albedo_ = 0;  // 0: not prepared for one view direction
};

/// Mean direction of a rough reflection, between the mirror direction r and the normal n.
/// Source:  Lagarde, de Rousiers, "Moving Frostbite to Physically Based Rendering 3.0", SIGGRAPH
///          2014 courses, 4.9.3: a fit for GGX.
/// Checked: EnvBlur.OneLookUpIsWhatManyRaysConvergeTo
inline Vec3 main_direction(const Vec3& r, const Vec3& n, float alpha) {
  const float smooth = clamp01(1 - alpha);
  return normalize(n + (r - n) * (smooth * (std::sqrt(smooth) + alpha)));
}

/// Blurred transmission of a thin sheet: the reflection lobe mirrored to the other side and centred
/// on the undeflected direction.
/// Checked: RoughThinTransmission.CentresOnTheStraightWay and the contract suite.
class RoughThinTransmission {
 public:
  RoughThinTransmission(float ax, float ay) : reflection_(ax, ay) {}
  /// Prepared for one view direction, like GlossyReflection.
  RoughThinTransmission(float ax, float ay, float inverse_albedo)
      : reflection_(ax, ay, inverse_albedo) {}
  RoughThinTransmission(float ax, float ay, const Vec3& wo) : reflection_(ax, ay, wo) {}

  float eval(const Vec3& wo, const Vec3& wi) const { return reflection_.eval(wo, flip(wi)); }
  float pdf(const Vec3& wo, const Vec3& wi) const { return reflection_.pdf(wo, flip(wi)); }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float u1) const {
    auto s = reflection_.sample(wo, u2, u1);
    if (s) s->wi = flip(s->wi);
    return s;
  }

 private:
  static Vec3 flip(const Vec3& w) { return Vec3(w.x, w.y, -w.z); }
  GlossyReflection reflection_;
};

}  // namespace oriel::bsdf
