// SPDX-License-Identifier: Apache-2.0
// Cumulative distributions over cells of equal width, for tables that are sampled by inversion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/vec.h"

namespace oriel::sampling {

inline constexpr float kBelowOne = 0x1.fffffep-1f;

/// A table's entry as a weight: negative and non-finite ones count as 0.
inline float usable(float v) { return std::isfinite(v) && v > 0 ? v : 0; }

/// Fills cdf (one longer than values) and returns the sum of the values. In double, because sums of
/// a million small terms lose precision in float.
template <class T>
double build_cdf(std::span<const T> values, std::span<float> cdf) {
  double total = 0;
  for (const T v : values) total += v;
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  cdf[0] = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += total > 0 ? values[i] / total : 1 / n;
    cdf[i + 1] = static_cast<float>(std::min(sum, 1.0));
  }
  // Set everything after the last cell with weight to exactly 1, so that no u below 1 selects it.
  std::size_t last = values.size();
  while (total > 0 && last > 1 && values[last - 1] == 0) --last;
  for (std::size_t i = last; i <= values.size(); ++i) cdf[i] = 1;
  return total;
}

/// The cell of x in [0,1].
inline std::size_t cell_of(float x, std::size_t count) {
  const float i = clamp01(x) * static_cast<float>(count);
  return std::min(static_cast<std::size_t>(i), count - 1);
}

}  // namespace oriel::sampling
