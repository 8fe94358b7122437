// SPDX-License-Identifier: Apache-2.0
// Converts linear pixels to values of an integer picture: gamma, clipping, premultiplication.
#pragma once

#include "base/vec.h"
#include "color/luminance.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// How out-of-range colour and alpha are clipped (option `colorclip`).
enum class ColorClip {
  Raw,        ///< `raw`: each component is clipped to 0...1 independently
  KeepColor,  ///< `rgb`: alpha is raised to the maximum of R, G, B; colour is unchanged
  KeepAlpha,  ///< `alpha`: R, G, B are lowered to alpha; alpha is unchanged
};

struct ViewOptions {
  float gamma = 1;  ///< exponent 1 / gamma for colour; alpha is not encoded
  ColorClip clip = ColorClip::Raw;
  bool desaturate = false;  ///< desaturates out-of-range colours and preserves their intensity
  bool premultiply = true;  ///< false: colour is divided by alpha
  Rgb luminance_weight = kRec709Luminance;  ///< weights of the intensity for desaturation
};

/// Converts one premultiplied linear colour to the values of an integer file, each in 0...1.
///
/// Model:   1. without premultiply, colour is divided by alpha (unchanged where alpha is 0); 2.
///          desaturate moves the colour towards the grey of its intensity until it is in range, in
///          linear light; 3. gamma; 4. colorclip, last because it applies to the stored numbers
///          (without premultiply every mode acts as Raw); 5. clip to 0...1.
/// Returns: a finite value for every input; NaN becomes 0. Dithering is applied on conversion to
///          integers (png.h).
/// Source:  mental ray manual, "Color Calculations": rgb raises alpha, alpha lowers colour.
/// Checked: View.*
Rgba view_color(const Rgba& linear, const ViewOptions& options);

/// Converts a picture of 1 to 4 channels (grey, grey + alpha, RGB, RGBA).
Image view_image(const Image& linear, const ViewOptions& options);

}  // namespace oriel
