// SPDX-License-Identifier: Apache-2.0
// Pictures of numbers: values as colours, with lines of equal value and a legend beside them.
#pragma once

#include <string>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// Colour of t in 0...1 (clamped), as displays take it (sRGB).
///
/// Model:   viridis: dark to bright in even steps of lightness, readable without colour.
/// Source:  S. van der Walt, N. Smith, matplotlib's viridis (2015, CC0): every 17th of its 256
///          colours, straight lines between; within 0.02 of the table.
/// Checked: FalseColor.LightnessRisesEvenly
Rgb viridis(float t);

/// What colours stand for.
struct ValueScale {
  float low = 0, high = 1;  ///< low < high; logarithmic: low > 0
  bool logarithmic = false;

  /// 0 at low, 1 at high, clamped.
  float position(float value) const;
};

/// A scale that shows the values: from 0 (logarithmic: a round number near the darkest hundredth)
/// to a round number near the brightest hundredth. Not a number, infinity and values of 0 and less
/// do not count.
ValueScale scale_of(const Image& values, bool logarithmic);

/// Round numbers within the scale, 4 to 10 of them, ascending. Logarithmic over a decade and more:
/// 1, 2, 5 of each decade, or decades alone.
/// Checked: FalseColor.TicksAreRoundAndWithinTheScale
std::vector<float> scale_ticks(const ValueScale& scale);

/// "0.5", "320", "1500", "12k": short.
std::string tick_text(float value);

struct FalseColorOptions {
  ValueScale scale;
  bool isolines = false;  ///< black lines where values pass a tick
  std::string unit = {};  ///< over the legend, in characters of glyphs.h
};

/// The values' first channel as an RGB picture for display, legend at its right.
///
/// Model:   values that are 0, or not a number (nothing is there), are black.
/// Returns: as high as the values (at least enough for the legend), wider by the legend.
/// Checked: FalseColor.*
Image false_color(const Image& values, const FalseColorOptions& options);

}  // namespace oriel
