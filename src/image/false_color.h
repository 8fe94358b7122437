// SPDX-License-Identifier: Apache-2.0
// False-colour pictures: values as colours, with isolines and a legend.
#pragma once

#include <string>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// Display-encoded (sRGB) colour of t in 0...1 (clamped).
///
/// Model:   viridis: lightness rises evenly, so the picture is readable without colour.
/// Source:  S. van der Walt, N. Smith, matplotlib's viridis (2015, CC0): every 17th of its 256
///          colours, interpolated linearly; within 0.02 of the table.
/// Checked: FalseColor.LightnessRisesEvenly
Rgb viridis(float t);

/// The range of values that the colours represent.
struct ValueScale {
  float low = 0, high = 1;  ///< low < high; logarithmic: low > 0
  bool logarithmic = false;

  /// 0 at low, 1 at high, clamped.
  float position(float value) const;
};

/// A scale for the given values. It starts at 0 (logarithmic: at a round number near the 1st
/// percentile) and ends at a round number near the 99th percentile. NaN, infinity and values <= 0
/// are ignored.
ValueScale scale_of(const Image& values, bool logarithmic);

/// Round numbers within the scale, 4 to 10 of them, ascending. Logarithmic over a decade and more:
/// 1, 2, 5 of each decade, or decades alone.
/// Checked: FalseColor.TicksAreRoundAndWithinTheScale
std::vector<float> scale_ticks(const ValueScale& scale);

/// Short text of a value: "0.5", "320", "1500", "12k".
std::string tick_text(float value);

struct FalseColorOptions {
  ValueScale scale;
  bool isolines = false;  ///< black lines where values cross a tick
  std::string unit = {};  ///< text above the legend, in characters of glyphs.h
};

/// Shows the first channel of the values as an RGB display picture with the legend at the right.
///
/// Model:   pixels with value 0 or NaN (no hit) are black.
/// Returns: a picture with the height of the values (or of the legend, if that is higher), wider by
///          the legend.
/// Checked: FalseColor.*
Image false_color(const Image& values, const FalseColorOptions& options);

}  // namespace oriel
