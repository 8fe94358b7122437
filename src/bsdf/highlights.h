// SPDX-License-Identifier: Apache-2.0
// Highlights of light sources in the models of mental ray's illumination shaders.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

// Conventions
//   As bsdf/lobe_sample.h, with eval alone: light sources are weighed by these, rays do not follow
//   them. Values include |cos wi|. Like phong.h, a light's irradiance-like colour times pi times
//   eval is what is seen. How bright mental ray's own highlights of these models are is not
//   published; these are the normalised reflectances of the papers.

/// Facets of Beckmann's slopes with Blinn's masking and Fresnel's reflectance.
///
/// Inputs:  slope: root mean square slope of the facets, > 0; eta: index of the material, >= 1.
/// Source:  Cook, Torrance, "A Reflectance Model for Computer Graphics", ACM TOG 1(1), 1982, with
///          pi in place of 4 as denominators of later papers have it; Blinn, SIGGRAPH 1977, for the
///          masking.
/// Checked: Highlights.Torrance*
struct TorranceHighlight {
  float slope = 0.3f;
  float eta = 1.5f;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

/// An anisotropic Gaussian of slopes.
///
/// Inputs:  alpha_x, alpha_y: root mean square slopes along x and y of the frame, > 0.
/// Source:  Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992, equation 5a.
/// Checked: Highlights.Ward*
struct WardHighlight {
  float alpha_x = 0.2f, alpha_y = 0.2f;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

/// The cone that a fibre along x mirrors, to a power; whichever side of the ribbon is lit.
///
/// Returns: eval: cos^exponent / pi of the angle to the cone, not normalised, as Phong's.
/// Source:  Kajiya, Kay, "Rendering Fur with Three Dimensional Textures", SIGGRAPH 1989, section 4.
/// Checked: Highlights.Hair*
struct HairHighlight {
  float exponent = 1;
  float eval(const Vec3& wo, const Vec3& wi) const;
};

}  // namespace oriel::bsdf
