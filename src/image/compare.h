// SPDX-License-Identifier: Apache-2.0
// How far two pictures are apart: the numbers of `oriel diff` and of the convergence tests.
#pragma once

#include <cstddef>

#include "image/pixel_buffer.h"

namespace oriel {

/// Regularises relative MSE where the reference is near black, in squared picture units.
/// Source: F. Rousselle, C. Knaus, M. Zwicker, "Adaptive Sampling and Reconstruction using Greedy
/// Error Minimization", TOG 30(6), 2011, section 6.
inline constexpr float kRelativeMseEpsilon = 1e-2f;

struct Difference {
  double rmse = 0;           ///< root of the mean squared difference over pixels and channels
  double mean_abs = 0;       ///< mean absolute difference
  double relative_mse = 0;   ///< mean of (t - r)^2 / (r^2 + epsilon)
  float max_abs = 0;         ///< largest absolute difference, where both are finite
  int max_x = 0, max_y = 0;  ///< its pixel, row 0 at the top; the first of equals
  int max_channel = 0;
  std::size_t not_finite = 0;  ///< values left out of all of the above: not finite in either one
};

/// Compares channel by channel, on the values as they are.
///
/// Errors:  std::runtime_error when the sizes or channel counts differ.
/// Checked: Compare.*
Difference compare(const Image& test, const Image& reference, float epsilon = kRelativeMseEpsilon);

}  // namespace oriel
