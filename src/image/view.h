// SPDX-License-Identifier: Apache-2.0
// From linear film to the values of an integer picture: gamma, clipping, premultiplication.
#pragma once

#include "base/vec.h"
#include "color/luminance.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// How colour and alpha are made to fit each other (option `colorclip`).
enum class ColorClip {
  Raw,        ///< `raw`: not at all; each is cut to 0...1 by itself
  KeepColor,  ///< `rgb`: alpha is raised to the largest of R, G, B; colour is kept
  KeepAlpha,  ///< `alpha`: R, G, B are lowered to alpha; alpha is kept
};

struct ViewOptions {
  float gamma = 1;  ///< colour gets the exponent 1 / gamma; alpha never does
  ColorClip clip = ColorClip::Raw;
  bool desaturate = false;  ///< out-of-range colours fade towards white and keep their intensity
  bool premultiply = true;  ///< off: colour is divided by alpha
  Rgb luminance_weight = kRec709Luminance;  ///< what "intensity" is
};

/// One premultiplied linear colour as an integer file stores it, each component in 0...1.
///
/// Model:   1. premultiply off divides (where alpha is 0 the colour stays); 2. desaturate moves the
///          colour towards the grey of its intensity until it is in range, in linear light; 3.
///          gamma; 4. colorclip, last, since it speaks of the numbers that are stored (without
///          premultiplication there is nothing to couple and every mode is Raw); 5. cut to 0...1.
/// Returns: total: not a number becomes 0. Dithering happens where the integers are made (png.h).
/// Source:  mental ray manual, "Color Calculations": rgb raises alpha, alpha lowers colour.
/// Checked: View.*
Rgba view_color(const Rgba& linear, const ViewOptions& options);

/// The same for a picture of 1 to 4 channels (grey, grey + alpha, RGB, RGBA).
Image view_image(const Image& linear, const ViewOptions& options);

}  // namespace oriel
