// SPDX-License-Identifier: Apache-2.0
// oriel_bump: normals of a height, as Blender's bump node.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "overall_bump" = "bump" of a mia_material_x, both with the same bump_mode. Surfaces need no
//   texture coordinates. Declared by `$include "oriel.mi"`.
// Model
//   Slopes of the height are differences of the input at points of the tangent plane, half the
//   width of a pixel away; texture coordinates of the first space move with them. The normal of the
//   surface whose height is `distance` times the input is mixed with the smooth one by `strength`.
// Source:  Mikkelsen, "Bump Mapping Unparametrized Surfaces on the GPU", 2010; Blender's manual,
// Bump
//          Node.
// Checked: tests/effects; tests/blender against Cycles
extern const ShaderSpec kOrielBump;

}  // namespace oriel
