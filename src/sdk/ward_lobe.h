// SPDX-License-Identifier: Apache-2.0
// The lobe of glossy directions and of Ward's highlight, by shininess.
#pragma once

#include "base/vec.h"

namespace oriel::sdk {

/// Directions mirrored at facets whose slopes are Gaussian.
///
/// Conventions: local frame, z = normal, wo.z > 0, u along x. As bsdf/lobe_sample.h.
/// Model:   root mean square slopes are 1 / shininess (Ward's alpha). A direction that would lie
///          below the surface is mirrored above it: the shader has no answer for a lost one.
/// Source:  Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992, equations 5 and
/// 6;
///          Walter, "Notes on the Ward BRDF", 2005, for the density.
/// Checked: Highlights.OfWard*, Directions.GlossyOnesMatchTheirDensity
class WardLobe {
 public:
  WardLobe(float shiny_u, float shiny_v);

  /// Always a direction with z > 0.
  Vec3 sample(const Vec3& wo, const Vec2& u) const;
  /// Density of sample() per solid angle.
  float pdf(const Vec3& wo, const Vec3& wi) const;
  float alpha_x() const { return ax_; }
  float alpha_y() const { return ay_; }

 private:
  float mirror_pdf(const Vec3& wo, const Vec3& wi) const;
  float ax_, ay_;
};

}  // namespace oriel::sdk
