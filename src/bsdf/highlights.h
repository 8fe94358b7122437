// SPDX-License-Identifier: Apache-2.0
// Highlights of light sources in mental ray's illumination shaders.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

// Conventions
//   As in bsdf/lobe_sample.h, but eval only: these models weight light sources and are not sampled.
//   Values include |cos wi|. As in phong.h, the visible result is the irradiance-like colour of a
//   light times pi times eval. The brightness of mental ray's own highlights is unpublished; these
//   are the normalised reflectances of the papers.

/// Microfacets with Beckmann slopes, Blinn's masking and Fresnel reflectance.
///
/// Inputs:  slope: root mean square slope of the facets, > 0; eta: index of the material, >= 1.
/// Source:  Cook, Torrance, "A Reflectance Model for Computer Graphics", ACM TOG 1(1), 1982, with
///          the normalised slope distribution of later papers (pi instead of 4 in the denominator);
///          Blinn, SIGGRAPH 1977, for the masking.
/// Checked: Highlights.Torrance*
struct TorranceHighlight {
  float slope = 0.3f;
  float eta = 1.5f;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

/// Anisotropic Gaussian distribution of slopes.
///
/// Inputs:  alpha_x, alpha_y: root mean square slopes along x and y of the frame, > 0.
/// Source:  Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992, equation 5a.
/// Checked: Highlights.Ward*
struct WardHighlight {
  float alpha_x = 0.2f, alpha_y = 0.2f;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

/// Reflection cone of a fibre along x, raised to a power; independent of the lit side of the
/// ribbon.
///
/// Returns: eval: cos^exponent / pi of the angle to the cone, not normalised, like Phong's.
/// Source:  Kajiya, Kay, "Rendering Fur with Three Dimensional Textures", SIGGRAPH 1989, section 4.
/// Checked: Highlights.Hair*
struct HairHighlight {
  float exponent = 1;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

}  // namespace oriel::bsdf
