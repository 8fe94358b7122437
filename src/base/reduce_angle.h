// SPDX-License-Identifier: Apache-2.0
// Angles without their multiples of pi/2, for math.cpp.
#pragma once

#include <cstdint>

namespace oriel::math {

/// x = k pi/2 + r + low.
struct Reduced {
  double r;               ///< in [-pi/4, pi/4], rounded
  double low;             ///< what rounding took from it
  std::uint32_t quarter;  ///< k modulo 4
};

/// Model:   up to 2^27 by three constants that add up to pi/2 (Cody and Waite, "Software Manual for
///          the Elementary Functions", 1980); beyond by the bits of 2/pi that matter (Payne and
///          Hanek, "Radian Reduction for Trigonometric Functions", SIGNUM 18(1), 1983).
/// Inputs:  finite x.
/// Checked: Math.LargeAnglesAreReducedExactly
Reduced reduce_angle(double x);

/// The nearest integer to |x| < 2^51, ties to even.
inline double round_to_int(double x) {
  constexpr double kRound = 0x1.8p+52;  // adding it leaves no bits behind the point
  return (x + kRound) - kRound;
}

}  // namespace oriel::math
