// SPDX-License-Identifier: Apache-2.0
// Gradient noise for procedural textures.
#pragma once

#include "base/vec.h"

namespace oriel::sampling {

/// Improved gradient noise: 0 at integer coordinates, C2 continuous, with a period of 256 units.
///
/// Inputs:  p: any; the noise is 0 if p is not finite.
/// Returns: within [-1, 1], mean 0.
/// Source:  Perlin, "Improving Noise", ACM TOG 21(3), 2002, with his permutation. Checked:
///          GradientNoise.*
float gradient_noise(const Vec3& p);

}  // namespace oriel::sampling
