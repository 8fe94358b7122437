// SPDX-License-Identifier: Apache-2.0
// Gradient noise without a period in one to four dimensions.
#pragma once

#include <span>

namespace oriel::sampling {

/// Gradient noise whose gradients are chosen by lattice_hash().
///
/// Inputs:  at: one to four coordinates; the noise is 0 if one is not finite or beyond 2^30.
/// Returns: within about [-1, 1], mean 0; 0 at integer coordinates; C2 continuous.
/// Source:  Perlin, "Improving Noise", ACM TOG 21(3), 2002; the hash, the gradients of other
///          dimensions and the normalization are those of Open Shading Language, which Blender has.
/// Checked: HashedNoise.*; tests/blender against Cycles
float hashed_noise(std::span<const float> at);

}  // namespace oriel::sampling
