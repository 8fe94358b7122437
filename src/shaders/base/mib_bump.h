// SPDX-License-Identifier: Apache-2.0
// mib_bump_basis, mib_bump_map, mib_passthrough_bump_map, mib_bump_map2: bump mapping.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   normal' = normalize(normal + factor (t(x + step, y) - t(x, y)) u + factor (t(x, y + step) - t)
//   v), where t is the mean of the texture channels, or its alpha. The normal of the point is
//   modified; a returned vector is the front-side normal. Outside of 0..1 the picture repeats with
//   a torus flag; otherwise its border is extended.
// Source:  the vendor's pages on the shaders.
// Checked: BaseBump.* in tests/shader_binding.

/// Directions of a texture space, or of a projection from object space: 1 xy, 2 xz, 3 yz, 4
/// spherical, 6 cylindrical (both about y); 5 and values <= 0 select the texture space. Unit
/// vectors in world space.
extern const ShaderSpec kMibBumpBasis;
extern const ShaderSpec kMibBumpMap;
extern const ShaderSpec kMibPassthroughBumpMap;
/// The first texture space times `scale` (0 = 1), with a step of 0.01; returns the colour or
/// material.
extern const ShaderSpec kMibBumpMap2;

}  // namespace oriel
