// SPDX-License-Identifier: Apache-2.0
// mib_texture_checkerboard, polkadot, polkasphere, turbulence, wave: procedural textures.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// The unit cube divided into eight boxes; the digits of a colour are x, y, z, where 0 is the low
/// side.
/// Source:  the vendor's page on the shader. Repetition of the cube is inferred.
extern const ShaderSpec kMibTextureCheckerboard;
/// A disc or a ball in the centre of each unit cell.
/// Source:  parameter names; the position of the dot in its cell is inferred.
extern const ShaderSpec kMibTexturePolkadot;
extern const ShaderSpec kMibTexturePolkasphere;
/// Model:   strength x sum over k < iteration of |noise(spacing 2^k p)| / 2^(k power).
/// Source:  the vendor's page describes the parameters; the sum is Perlin's (SIGGRAPH 1985).
///          polar_dim 1 (lines) ignores y, 2 (cylinders) uses the distance from the z axis through
///          the centre of the cell: a guess.
extern const ShaderSpec kMibTextureTurbulence;
/// offset + sum over the axes of amplitude x cos(2 pi coordinate), in all four channels.
/// Source:  the vendor's page; the wavelength is inferred.
extern const ShaderSpec kMibTextureWave;

}  // namespace oriel
