// SPDX-License-Identifier: Apache-2.0
// Gradient noise for procedural textures.
#pragma once

#include "base/vec.h"

namespace oriel::sampling {

/// Improved gradient noise: 0 at all whole coordinates, smooth to the second derivative, repeats
/// every 256 units.
///
/// Inputs:  p: any; where it is not finite the noise is 0.
/// Returns: within [-1, 1], mean 0.
/// Source:  Perlin, "Improving Noise", ACM TOG 21(3), 2002; the permutation is the one he
/// published. Checked: GradientNoise.*
float gradient_noise(const Vec3& p);

}  // namespace oriel::sampling
