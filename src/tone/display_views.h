// SPDX-License-Identifier: Apache-2.0
// Display views of exposed light, in addition to the curves of the exposure shaders: AgX and PBR
// Neutral.
#pragma once

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Input is linear Rec. 709, with 0.18 for a grey card and 1 for white without a view. Negative
//   components and NaN count as 0. Output is in 0..1.

/// The contrast curve of AgX.
///
/// Inputs:  x: 0..1, log2 of the colour from 10 stops below 0.18 to 6.5 above.
/// Model:   two hyperbolic branches that join at grey (10 / 16.5 maps to 0.5) with slope 2; powers
///          3 in the toe and 3.25 in the shoulder. 0 maps to 0 and 1 to 1 exactly.
/// Checked: DisplayViews.AgxCurveAgreesWithItsPublishedPolynomialFit
float agx_curve(float x);

/// AgX, base look. The result is display-encoded for sRGB.
///
/// Model:   inset matrix, log2, curve, inverse of the inset.
/// Source:  T. Sobotka, AgX (github.com/sobotka/AgX) and its sigmoid (SB2383-Configuration-
///          Generation); computed without tables, with inset matrix and order of B. Wrensch,
///          "Minimal AgX Implementation", 2023. Rows of the inset are normalised to a sum of 1, so
///          that grey is preserved.
/// Checked: DisplayViews.Agx*
Rgb agx(const Rgb& linear);

/// PBR Neutral. The result is linear and has to be encoded for the display (color/srgb.h).
///
/// Model:   colours below 0.8 keep their hue minus the 0.04 that dielectrics reflect; colours above
///          are compressed and desaturated.
/// Source:  Khronos Group, "Khronos PBR Neutral Tone Mapper", specification 1.0, 2024.
/// Checked: DisplayViews.Neutral*
Rgb pbr_neutral(const Rgb& linear);

}  // namespace oriel::lens
