// SPDX-License-Identifier: Apache-2.0
// oriel_wave, oriel_magic: bands, rings and coloured waves, as Blender's wave and magic textures.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Textures of modelling programs. Declared by `$include "oriel.mi"`.
// Model
//   oriel_wave: x = 20 times the coordinate of an axis, 10 times the sum of all, or 20 times the
//   distance to an axis or to the origin, plus `phase` and the noise in -1..1 times `distortion`;
//   the profile is 0.5 - 0.5 cos x, a saw or a triangle of the period 2 pi. oriel_magic: sines of
//   sums of the coordinates, repeatedly of the results of each other.
// Source:  Blender's manual, Wave and Magic Texture Nodes.
// Checked: tests/blender against Cycles; tests/effects
extern const ShaderSpec kOrielWave;
extern const ShaderSpec kOrielMagic;

}  // namespace oriel
