// SPDX-License-Identifier: Apache-2.0
// oriel_brick: bricks with mortar, as Blender's brick texture.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Textures of modelling programs. Declared by `$include "oriel.mi"`.
// Model
//   Rows of bricks in x and y. Every `offset_rows`th row is moved by `offset` widths, and the
//   bricks of all rows but every `squash_rows`th keep their width; the others have `squash` times
//   it. Each brick has a random mixture of two colours. Mortar is nearer to the edge than
//   `mortar_size`.
// Source:  Blender's manual, Brick Texture Node; the random number of a brick is that of Blender.
// Checked: tests/blender against Cycles; tests/effects
extern const ShaderSpec kOrielBrick;

}  // namespace oriel
