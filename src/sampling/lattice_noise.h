// SPDX-License-Identifier: Apache-2.0
// Smooth noise in one, two and three dimensions, with its gradient.
#pragma once

#include <array>

namespace oriel::sampling {

/// Noise value and gradient at a point.
template <int kDimensions>
struct NoiseAt {
  float value = 0;
  std::array<float, kDimensions> slope{};
};

/// Noise with mean 0: each integer lattice point has a random value and a random gradient,
/// interpolated smoothly. Unlike plain gradient noise it is not zero at all lattice points, and it
/// does not repeat.
///
/// Returns: magnitude at most noise_bound(), mean 0; C2 continuous.
/// Errors:  none; returns 0 if the position is not finite.
/// Source:  original construction based on Perlin, "Improving Noise", ACM TOG 21(3), 2002
///          (polynomial), and Lewis, "Algorithms for Solid Noise Synthesis", SIGGRAPH 1989 (values
///          in addition to gradients).
/// Checked: LatticeNoise.*
template <int kDimensions>
NoiseAt<kDimensions> lattice_noise(const std::array<float, kDimensions>& at);

template <int kDimensions>
float noise_bound();

enum class NoiseShape {
  Bell,  ///< bell-shaped about 0.5 with standard deviation 0.14
  Even   ///< uniform distribution of values
};

/// The lattice noise mapped to 0...1, with the gradient of the result.
///
/// Checked: ShapedNoise.*
template <int kDimensions>
NoiseAt<kDimensions> shaped_noise(const std::array<float, kDimensions>& at, NoiseShape shape);

}  // namespace oriel::sampling
