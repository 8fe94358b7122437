// SPDX-License-Identifier: Apache-2.0
// Sample points for shader sampling loops of unknown length, and the generator of erand48.
#pragma once

#include <array>
#include <cstdint>

#include "sampling/sampler.h"

namespace oriel::sampling {

/// A point set shared by all loops, shifted by random numbers. The shift makes each point uniform
/// in the unit square; the points of one loop cover it evenly.
///
/// Source:  Cranley, Patterson, "Randomization of Number Theoretic Methods for Multiple
///          Integration", 1976.
/// Checked: ShiftedNet.*, Sample.*
class ShiftedNet {
 public:
  /// Pairs of dimensions that are stratified over the samples; further ones are independent.
  static constexpr int kPairs = 4;

  /// Inputs:  next: returns two independent numbers in [0,1).
  template <class Next>
  void start(int dimensions, const Next& next) {
    for (int k = 0; k < kPairs && 2 * k < dimensions; ++k)
      shift_[static_cast<std::size_t>(k)] = next();
  }

  /// Writes the coordinates of a point; pairs beyond kPairs come from `next`.
  template <class Next>
  void fill(double* sample, int dimensions, int index, const Next& next) const {
    Sampler net(0, 0, static_cast<std::uint32_t>(index));
    for (int k = 0; 2 * k < dimensions; ++k) {
      Vec2 u;
      if (k < kPairs) {
        u = net.next_2d() + shift_[static_cast<std::size_t>(k)];
        u = Vec2(wrapped(u.x), wrapped(u.y));
      } else {
        u = next();
      }
      sample[2 * k] = u.x;
      if (2 * k + 1 < dimensions) sample[2 * k + 1] = u.y;
    }
  }

 private:
  static float wrapped(float x) { return x < 1 ? x : x - 1; }

  std::array<Vec2, kPairs> shift_;
};

/// The next number of the POSIX erand48 generator in [0,1), truncated to 24 bits; advances the
/// seed, whose lowest 16 bits are first.
/// Model:   x = (0x5deece66d x + 11) mod 2^48.
/// Checked: Erand48.IsThatOfPosix
inline float erand48(unsigned short seed[3]) {
  const std::uint64_t x =
      std::uint64_t{seed[0]} | (std::uint64_t{seed[1]} << 16) | (std::uint64_t{seed[2]} << 32);
  const std::uint64_t y = (x * 0x5deece66dull + 11) & 0xffffffffffffull;
  seed[0] = static_cast<unsigned short>(y);
  seed[1] = static_cast<unsigned short>(y >> 16);
  seed[2] = static_cast<unsigned short>(y >> 32);
  return static_cast<float>(y >> 24) * 0x1p-24f;
}

}  // namespace oriel::sampling
