// SPDX-License-Identifier: Apache-2.0
// LDR-FLIP: visible difference of two display pictures that alternate on a screen.
#pragma once

#include "image/pixel_buffer.h"

namespace oriel {

/// Published default: a screen 0.7 m wide with 3840 pixels, viewed from 0.7 m.
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

/// Error per pixel in one channel, from 0 (equal) to 1 (maximum).
///
/// Model:   LDR-FLIP, written from the equations of the paper: contrast sensitivity filters in
///          YCxCz, Hunt-adjusted L*a*b* with the HyAB distance, edge and point features. Border
///          pixels are repeated outside the picture. It was not compared with the authors' program,
///          so the last digits may differ.
/// Inputs:  sRGB-encoded values in 0...1, as RGB (more channels are ignored) or grey (1 or 2
///          channels); other values are clipped. The measure is symmetric.
/// Errors:  std::runtime_error when the sizes differ.
/// Source:  P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", PACM CGIT
///          3(2), 2020, sections 4 and 5.
/// Checked: Flip.*
Image flip_error(const Image& test, const Image& reference,
                 float pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of all values of a picture.
double mean_value(const Image& image);

}  // namespace oriel
