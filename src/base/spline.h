// SPDX-License-Identifier: Apache-2.0
// Interpolating splines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace oriel {

/// Catmull-Rom spline (tension 1/2) through equally spaced values. The ends are extrapolated
/// linearly, so collinear values give a line.
///
/// Inputs:  t: 0 at the first value ... 1 at the last, clamped; NaN counts as 0.
/// Returns: 0 if there are no values.
/// Source:  Catmull, Rom, "A Class of Local Interpolating Splines", 1974.
/// Checked: Spline.*
inline float catmull_rom(float t, std::span<const float> values) {
  const std::size_t n = values.size();
  if (n < 2) return n == 1 ? values[0] : 0;
  const float at = (t > 0 ? std::min(t, 1.0f) : 0.0f) * static_cast<float>(n - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(at), n - 2);
  const float f = at - static_cast<float>(first);
  const float b = values[first], c = values[first + 1];
  const float a = first > 0 ? values[first - 1] : 2 * b - c;
  const float d = first + 2 < n ? values[first + 2] : 2 * c - b;
  return b + 0.5f * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
}

}  // namespace oriel
