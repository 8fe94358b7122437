// SPDX-License-Identifier: Apache-2.0
// Blurred refraction into a medium.
#pragma once

#include <optional>

#include "base/assert.h"
#include "bsdf/fresnel.h"
#include "bsdf/glossy_reflection.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// White refraction blurred about the refracted view, without Fresnel and without eta^2 scaling of
/// radiance.
///
/// Model:   the lobe of a reflection of that roughness, turned so that its centre is the refracted
///          view, or the mirrored one where the view is reflected totally. How wide it is does not
///          depend on the index: facets that bend light less the nearer the index is to 1 would
///          leave glass of gloss 0 almost clear. Not reciprocal.
/// Inputs:  ax, ay: from gloss.h, not a mirror. eta: index of the far side over the viewer's side.
/// Source:  manual 1.6.3: gloss 0 is an extremely diffuse transparency.
/// Checked: RoughRefraction.FurnaceIsWhite, RoughRefraction.IsAsWideAsASheetWhateverTheIndex,
///          contract suite.
class RoughRefraction {
 public:
  RoughRefraction(float ax, float ay, float eta) : lobe_(ax, ay), eta_(eta) {
    ORIEL_ASSERT(ax > 0 && ay > 0 && eta > 0);
  }
  /// Made for one viewer: of albedo(ax, ay, eta, wo).
  RoughRefraction(float ax, float ay, float eta, float inverse_albedo)
      : lobe_(ax, ay, inverse_albedo), eta_(eta) {}

  /// The view that a reflection of that lobe has, for ggx_albedo().
  static Vec3 lobe_view(const Vec3& wo, float eta) {
    const auto refracted = refract(wo, Vec3(0, 0, 1), eta);
    return refracted ? -*refracted : wo;
  }

  float eval(const Vec3& wo, const Vec3& wi) const {
    return asked(wo, wi, [&](const Vec3& o, const Vec3& w) { return lobe_.eval(o, w); });
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return asked(wo, wi, [&](const Vec3& o, const Vec3& w) { return lobe_.pdf(o, w); });
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
  float asked(const Vec3& wo, const Vec3& wi, const F& f) const {
    if (wo.z <= 0) return 0;
    const auto refracted = refract(wo, Vec3(0, 0, 1), eta_);
    return refracted ? f(-*refracted, Vec3(wi.x, wi.y, -wi.z)) : f(wo, wi);
  }

  GlossyReflection lobe_;
  float eta_;
};

}  // namespace oriel::bsdf
