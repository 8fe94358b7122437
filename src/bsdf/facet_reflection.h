// SPDX-License-Identifier: Apache-2.0
// Rough dielectric boundary: each facet reflects by its own angle.
#pragma once

#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/glossy_reflection.h"

namespace oriel::bsdf {

/// Reflection of microfacets with the reflectance of a dielectric.
///
/// Model:   single scattering on GGX times Fresnel's reflectance at the angle between facet and
///          view. Light that facets scatter again is lost: it mostly enters the surface. Reciprocal
///          if scale is 1.
/// Inputs:  ax, ay: from gloss.h, not a mirror. eta: index of refraction of the far side over that
///          of the viewer's side. scale: factor, such as the inverse of an albedo.
/// Source:  Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
/// Checked: FacetReflection.*, the contract suite.
class FacetReflection {
 public:
  FacetReflection(float ax, float ay, float eta, float scale = 1)
      : facets_(ax, ay, scale), eta_(eta) {}

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    return facets_.eval(wo, wi) * reflectance(wo, wi);
  }

  float pdf(const Vec3& wo, const Vec3& wi) const { return facets_.pdf(wo, wi); }

  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float u1) const {
    std::optional<LobeSample> s = facets_.sample(wo, u2, u1);
    if (s) s->weight *= reflectance(wo, s->wi);
    return s;
  }

 private:
  float reflectance(const Vec3& wo, const Vec3& wi) const {
    return fresnel_dielectric(dot(wo, normalize(wo + wi)), eta_);
  }

  GlossyReflection facets_;
  float eta_;
};

}  // namespace oriel::bsdf
