// SPDX-License-Identifier: Apache-2.0
// mib_texture_checkerboard, polkadot, polkasphere, turbulence, wave: patterns without pictures.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// The unit cube in eight boxes; the digits of a colour stand for x, y, z, 0 is the low side.
/// Source:  the vendor's page of the shader. That the cube repeats is inferred.
extern const ShaderSpec kMibTextureCheckerboard;
/// A disc, or a ball, in the middle of each unit cell.
/// Source:  parameter names; where the dot lies in its cell is inferred.
extern const ShaderSpec kMibTexturePolkadot;
extern const ShaderSpec kMibTexturePolkasphere;
/// Model:   strength x sum over k < iteration of |noise(spacing 2^k p)| / 2^(k power).
/// Source:  the vendor's page has the parameters in words; the sum is Perlin's (SIGGRAPH 1985).
///          polar_dim 1 (lines) leaves out y, 2 (cylinders) goes by the distance from the z axis
///          through the cell's middle: a guess.
extern const ShaderSpec kMibTextureTurbulence;
/// offset + sum over the axes of amplitude x cos(2 pi coordinate), in all four channels.
/// Source:  the vendor's page; the wave's length is inferred.
extern const ShaderSpec kMibTextureWave;

}  // namespace oriel
