// SPDX-License-Identifier: Apache-2.0
// How different two display pictures look when one flips between them (LDR-FLIP).
#pragma once

#include "image/pixel_buffer.h"

namespace oriel {

/// 0.7 m in front of a screen 0.7 m wide with 3840 pixels: the published default.
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

/// Error per pixel, 0 (same) ... 1 (as different as can be), one channel.
///
/// Model:   LDR-FLIP written from the paper's equations: contrast sensitivity filters in YCxCz,
///          Hunt-adjusted L*a*b* with the HyAB distance, edge and point features. Outside the
///          picture the border pixel goes on. It has not been run against the authors' program,
///          so figures of the two may differ in the last digits.
/// Inputs:  sRGB-encoded RGB, 0...1, 3 or more channels (the rest is ignored) or grey (1 or 2);
///          other values are clipped. The measure is symmetric.
/// Errors:  std::runtime_error when the sizes differ.
/// Source:  P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", PACM CGIT
///          3(2), 2020, sections 4 and 5.
/// Checked: Flip.*
Image flip_error(const Image& test, const Image& reference,
                 float pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of all values of a picture.
double mean_value(const Image& image);

}  // namespace oriel
