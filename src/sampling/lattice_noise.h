// SPDX-License-Identifier: Apache-2.0
// Smooth noise in one, two and three dimensions, with its gradient.
#pragma once

#include <array>

namespace oriel::sampling {

/// Noise and its gradient at a place.
template <int kDimensions>
struct NoiseAt {
  float value = 0;
  std::array<float, kDimensions> slope{};
};

/// Noise about 0: each point of the lattice of whole numbers has a value and a gradient of its own,
/// between which it runs smoothly. It has no zeros in common, as plain gradient noise has on the
/// lattice, and nothing repeats.
///
/// Returns: within noise_bound() either way, mean 0; continuous with its first two derivatives.
/// Errors:  total; 0 where the place is not finite.
/// Source:  own construction after Perlin, "Improving Noise", ACM TOG 21(3), 2002 (the polynomial),
///          and Lewis, "Algorithms for Solid Noise Synthesis", SIGGRAPH 1989 (values as well as
///          gradients).
/// Checked: LatticeNoise.*
template <int kDimensions>
NoiseAt<kDimensions> lattice_noise(const std::array<float, kDimensions>& at);

template <int kDimensions>
float noise_bound();

enum class NoiseShape {
  Bell,  ///< a bell about 0.5 of standard deviation 0.14
  Even   ///< all values equally often
};

/// The lattice noise mapped to 0...1, with the gradient of the result.
///
/// Checked: ShapedNoise.*
template <int kDimensions>
NoiseAt<kDimensions> shaped_noise(const std::array<float, kDimensions>& at, NoiseShape shape);

}  // namespace oriel::sampling
