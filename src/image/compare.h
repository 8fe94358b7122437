// SPDX-License-Identifier: Apache-2.0
// Error metrics between two pictures, for `oriel diff` and the convergence tests.
#pragma once

#include <cstddef>

#include "image/pixel_buffer.h"

namespace oriel {

/// Regularises relative MSE where the reference is near black, in squared picture units.
/// Source: F. Rousselle, C. Knaus, M. Zwicker, "Adaptive Sampling and Reconstruction using Greedy
/// Error Minimization", TOG 30(6), 2011, section 6.
inline constexpr float kRelativeMseEpsilon = 1e-2f;

struct Difference {
  double rmse = 0;          ///< root of the mean squared difference over pixels and channels
  double mean_abs = 0;      ///< mean absolute difference
  double relative_mse = 0;  ///< mean of (t - r)^2 / (r^2 + epsilon)
  float max_abs = 0;        ///< largest absolute difference of finite values
  /// pixel of max_abs, row 0 at the top; the first one if several are equal
  int max_x = 0, max_y = 0;
  int max_channel = 0;
  std::size_t not_finite = 0;  ///< values that are not finite in either picture; excluded above
};

/// Compares channel by channel, without conversion of the values.
///
/// Errors:  std::runtime_error when the sizes or channel counts differ.
/// Checked: Compare.*
Difference compare(const Image& test, const Image& reference, float epsilon = kRelativeMseEpsilon);

}  // namespace oriel
