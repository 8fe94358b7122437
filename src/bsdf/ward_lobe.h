// SPDX-License-Identifier: Apache-2.0
// Sampling of Ward's lobe, with its width given as shininess.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

/// Root mean square slope of the facets (Ward's alpha): the reciprocal of shininess, clamped to
/// 1e-4 ... 10.
/// Checked: WardLobe.HasAWidestSlope
float ward_slope(float shininess);

/// Reflections at microfacets with Gaussian slopes.
///
/// Conventions: local frame, z = normal, wo.z > 0, u along x. As bsdf/lobe_sample.h.
/// Model:   root mean square slopes are 1 / shininess (Ward's alpha). A direction below the surface
///          is mirrored to above it, because the shader cannot return a lost sample.
/// Source:  Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992, equations 5
///          and 6; Walter, "Notes on the Ward BRDF", 2005, for the density.
/// Checked: WardLobe.*, Highlights.OfWard*,
///          Directions.GlossyDirectionsMatchTheirDensity
class WardLobe {
 public:
  WardLobe(float shiny_u, float shiny_v);

  /// The result always has z > 0.
  Vec3 sample(const Vec3& wo, const Vec2& u) const;
  /// Density of sample() per solid angle.
  float pdf(const Vec3& wo, const Vec3& wi) const;
  /// Radiance of Ward's highlight relative to a white Lambert surface: pi times the reflectance,
  /// without the cosine of wi that WardHighlight includes.
  float relative_to_lambert(const Vec3& wo, const Vec3& wi) const;

 private:
  float mirror_pdf(const Vec3& wo, const Vec3& wi) const;
  float ax_, ay_;
};

}  // namespace oriel::bsdf
