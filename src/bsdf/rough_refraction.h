// SPDX-License-Identifier: Apache-2.0
// Rough refraction into a medium.
#pragma once

#include <optional>

#include "base/assert.h"
#include "bsdf/fresnel.h"
#include "bsdf/glossy_reflection.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// White refraction blurred about the refracted view direction, without Fresnel and without eta^2
/// scaling of radiance.
///
/// Model:   the reflection lobe of the same roughness, rotated such that its centre is the
///          refracted direction, or the mirror direction on total internal reflection. Its width
///          does not depend on the index of refraction: with real microfacets, glass of gloss 0
///          would be almost clear for indices near 1. Not reciprocal.
/// Inputs:  ax, ay: from gloss.h, not a mirror. eta: index of the far side over the viewer's side.
/// Source:  manual 1.6.3: gloss 0 is an extremely diffuse transparency.
/// Checked: RoughRefraction.FurnaceIsWhite, RoughRefraction.IsAsWideAsASheetWhateverTheIndex,
///          contract suite.
class RoughRefraction {
 public:
  RoughRefraction(float ax, float ay, float eta) : lobe_(ax, ay), eta_(eta) {
    ORIEL_ASSERT(ax > 0 && ay > 0 && eta > 0);
  }
  /// Prepared for one view direction with the inverse of albedo(ax, ay, eta, wo).
  RoughRefraction(float ax, float ay, float eta, float inverse_albedo)
      : lobe_(ax, ay, inverse_albedo), eta_(eta) {}

  /// The equivalent view direction of the reflection lobe, for ggx_albedo().
  static Vec3 lobe_view(const Vec3& wo, float eta) {
    const auto refracted = refract(wo, Vec3(0, 0, 1), eta);
    return refracted ? -*refracted : wo;
  }

  float eval(const Vec3& wo, const Vec3& wi) const {
    return evaluate(wo, wi, [&](const Vec3& o, const Vec3& w) { return lobe_.eval(o, w); });
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return evaluate(wo, wi, [&](const Vec3& o, const Vec3& w) { return lobe_.pdf(o, w); });
  }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float u1) const {
    if (wo.z <= 0) return std::nullopt;
    const auto refracted = refract(wo, Vec3(0, 0, 1), eta_);
    auto s = lobe_.sample(refracted ? -*refracted : wo, u2, u1);
    if (s && refracted) s->wi.z = -s->wi.z;
    return s;
  }

 private:
  template <class F>
  float evaluate(const Vec3& wo, const Vec3& wi, const F& f) const {
    if (wo.z <= 0) return 0;
    const auto refracted = refract(wo, Vec3(0, 0, 1), eta_);
    return refracted ? f(-*refracted, Vec3(wi.x, wi.y, -wi.z)) : f(wo, wi);
  }

  GlossyReflection lobe_;
  float eta_;
};

}  // namespace oriel::bsdf
