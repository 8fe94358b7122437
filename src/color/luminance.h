// SPDX-License-Identifier: Apache-2.0
// Luminance weights of linear RGB colours.
#pragma once

#include "base/vec.h"

namespace oriel {

/// Rec. 709 / sRGB weights; Oriel's default.
/// Source: ITU-R BT.709-6, section 3.2 (rounded to four digits as everywhere in practice).
inline const Rgb kRec709Luminance{0.2126f, 0.7152f, 0.0722f};
/// NTSC weights: mental ray's historic default of `mi_luminance`, a scene option in Oriel.
/// Source: ITU-R BT.601-7, section 2.5.1.
inline const Rgb kNtscLuminance{0.299f, 0.587f, 0.114f};

/// Weighted sum of the channels: luminance if `c` is photometric RGB, intensity otherwise.
/// Checked: Luminance.WeightsSumToOne, Luminance.GreyIsItsOwnLuminance
inline float luminance(const Rgb& c, const Rgb& weights) {
  return c.x * weights.x + c.y * weights.y + c.z * weights.z;
}
/// Rec. 709 luminance.
inline float luminance(const Rgb& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

}  // namespace oriel
