// SPDX-License-Identifier: Apache-2.0
// Blurred refraction into a medium.
#pragma once

#include <optional>

#include "base/assert.h"
#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// White refraction through a GGX surface, without Fresnel and without eta^2 scaling of radiance.
///
/// Model:   each normal the viewer sees refracts, or reflects where it reflects totally; the lobe
///          is the density of what results, so its weight is always 1 and no energy is lost.
///          Shadowing of the outgoing side is left out (a shadowed ray would pass the surface once
///          more and come out nearby), and what would leave on the wrong side of the surface is
///          folded over to the right one. Not reciprocal.
///          With an index within kNoBending of 1 there is no blur either: light goes straight.
/// Inputs:  ax, ay: from gloss.h, not a mirror. eta: index of the far side over the viewer's side.
/// Source:  Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007,
///          eq. 16-17.
/// Checked: RoughRefraction.FurnaceIsWhite, RoughRefraction.SpreadFallsWithGloss, contract suite.
class RoughRefraction {
 public:
  static constexpr float kNoBending = 1e-3f;

  RoughRefraction(float ax, float ay, float eta) : ggx_{ax, ay}, eta_(eta) {
    ORIEL_ASSERT(ax > 0 && ay > 0 && eta > 0);
  }

  float eval(const Vec3& wo, const Vec3& wi) const { return pdf(wo, wi); }

  float pdf(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || is_straight()) return 0;
    const Vec3 folded(wi.x, wi.y, -wi.z);
    if (wi.z < 0) return refracted_pdf(wo, wi) + refracted_pdf(wo, folded);
    return eta_ < 1 ? reflected_pdf(wo, wi) + reflected_pdf(wo, folded) : 0;
  }

  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    if (is_straight()) return LobeSample{-wo, 1, 1, true};
    const Vec3 h = ggx_.sample_visible(wo, u2);
    Vec3 wi;
    if (const auto refracted = refract(wo, h, eta_)) {
      wi = *refracted;
      wi.z = -std::max(std::abs(wi.z), 1e-7f);
    } else {
      wi = reflect(wo, h);
      wi.z = std::max(std::abs(wi.z), 1e-7f);
    }
    const float density = pdf(wo, wi);
    if (!(density > 0)) return std::nullopt;
    return LobeSample{wi, 1, density, false};
  }

 private:
  bool is_straight() const { return std::abs(eta_ - 1) < kNoBending; }

  float refracted_pdf(const Vec3& wo, const Vec3& wi) const {
    Vec3 h = wo + wi * eta_;
    if (h.z < 0) h = -h;
    h = normalize(h);
    const float co = dot(wo, h), ci = dot(wi, h);
    if (co <= 0 || ci >= 0) return 0;
    return ggx_.visible_pdf(wo, h) * eta_ * eta_ * -ci / sqr(co + eta_ * ci);
  }

  float reflected_pdf(const Vec3& wo, const Vec3& wi) const {
    const Vec3 h = normalize(wo + wi);
    const float co = dot(wo, h);
    if (h.z <= 0 || co <= 0 || 1 - co * co < eta_ * eta_) return 0;
    return ggx_.visible_pdf(wo, h) / (4 * co);
  }

  Ggx ggx_;
  float eta_;
};

}  // namespace oriel::bsdf
