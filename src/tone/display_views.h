// SPDX-License-Identifier: Apache-2.0
// Ready-made pictures of exposed light, beside the exposures' own curves: AgX and PBR Neutral.
#pragma once

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Input is linear with the primaries of Rec. 709, 0.18 is a grey card, 1 is white without a view.
//   Negative components and what is not a number count as 0. Output is in 0..1.

/// The contrast curve of AgX.
///
/// Inputs:  x: 0..1, log2 of the colour from 10 stops below 0.18 to 6.5 above.
/// Model:   two hyperbolic branches that meet at grey (10 / 16.5 to 0.5) with slope 2; powers 3 in
///          the toe and 3.25 in the shoulder. From exactly 0 to exactly 1.
/// Checked: DisplayViews.AgxCurveAgreesWithItsPublishedPolynomialFit
float agx_curve(float x);

/// AgX, base look. Display-encoded: values for an sRGB display as they are.
///
/// Model:   inset matrix, log2, curve, inverse of the inset.
/// Source:  T. Sobotka, AgX (github.com/sobotka/AgX) and its sigmoid (SB2383-Configuration-
///          Generation); without tables, with inset matrix and order as in B. Wrensch, "Minimal AgX
///          Implementation", 2023. Rows of the inset are scaled to sum to 1, so that grey stays
///          grey.
/// Checked: DisplayViews.Agx*
Rgb agx(const Rgb& linear);

/// PBR Neutral. Linear: still to be encoded for the display (color/srgb.h).
///
/// Model:   below 0.8 colours keep their hue and lose the 0.04 that dielectrics reflect; above they
///          are compressed and fade to white.
/// Source:  Khronos Group, "Khronos PBR Neutral Tone Mapper", specification 1.0, 2024.
/// Checked: DisplayViews.Neutral*
Rgb pbr_neutral(const Rgb& linear);

}  // namespace oriel::lens
