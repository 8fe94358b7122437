// SPDX-License-Identifier: Apache-2.0
// mib_bump_basis, mib_bump_map, mib_passthrough_bump_map, mib_bump_map2: pictures that move
// normals.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   normal' = normalize(normal + factor (t(x + step, y) - t(x, y)) u + factor (t(x, y + step) - t)
//   v) with t the mean of the texture's channels, or its alpha. The point's normal is moved; what a
//   vector is returned for has it as that of the front. Beyond 0..1 the picture repeats with a
//   torus flag, or else its border goes on.
// Source:  the vendor's pages of the shaders.
// Checked: BaseBump.* in tests/shader_binding.

/// Directions of a texture space, or of a projection from object space: 1 xy, 2 xz, 3 yz,
/// 4 spherical, 6 cylindrical (both about y); 5, 0 and below: the texture space. Unit, world space.
extern const ShaderSpec kMibBumpBasis;
extern const ShaderSpec kMibBumpMap;
extern const ShaderSpec kMibPassthroughBumpMap;
/// The first texture space times `scale` (0 = 1), a step of 0.01; then the colour or material.
extern const ShaderSpec kMibBumpMap2;

}  // namespace oriel
