// SPDX-License-Identifier: Apache-2.0
// Simple tone operators: Reinhard's curve, and gamut clipping towards white.
#pragma once

#include <algorithm>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::tone {

/// Moves all channels towards their mean until the maximum is 1; white if the mean is above 1.
/// Checked: SimpleOperators.*
inline Rgb desaturate_to_one(const Rgb& c) {
  const float largest = std::max({c.x, c.y, c.z});
  if (!(largest > 1)) return c;
  const float mean = (c.x + c.y + c.z) * (1.0f / 3);
  if (!(mean < 1)) return Rgb(1);
  const float keep = (1 - mean) / (largest - mean);
  return Rgb(mean + (c.x - mean) * keep, mean + (c.y - mean) * keep, mean + (c.z - mean) * keep);
}

/// Maps a value to 0...1: x / (1 + x) after a factor, then exponent 1 / gamma (1 if gamma <= 0).
/// Negative values and NaN become 0.
/// Source:  E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002,
///          equation 3.
/// Checked: SimpleOperators.*
inline float reinhard(float value, float exposure, float gamma) {
  const float c = value > 0 ? std::min(value * exposure, 1e30f) : 0.0f;
  return math::pow(c / (1 + c), gamma > 0 ? 1 / gamma : 1.0f);
}

}  // namespace oriel::tone
