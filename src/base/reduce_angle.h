// SPDX-License-Identifier: Apache-2.0
// Reduction of angles modulo pi/2, for math.cpp.
#pragma once

#include <cstdint>

namespace oriel::math {

/// x = k pi/2 + r + low.
struct Reduced {
  double r;               ///< in [-pi/4, pi/4], rounded
  double low;             ///< rounding error of r
  std::uint32_t quarter;  ///< k modulo 4
};

/// Model:   up to 2^27 by three constants that sum to pi/2 (Cody and Waite, "Software Manual for
///          the Elementary Functions", 1980); beyond with the relevant bits of 2/pi (Payne and
///          Hanek, "Radian Reduction for Trigonometric Functions", SIGNUM 18(1), 1983).
/// Inputs:  finite x.
/// Checked: Math.LargeAnglesAreReducedExactly
Reduced reduce_angle(double x);

/// The nearest integer to |x| < 2^51, ties to even.
inline double round_to_int(double x) {
  constexpr double kRound = 0x1.8p+52;  // adding it rounds to an integer
  return (x + kRound) - kRound;
}

}  // namespace oriel::math
