// SPDX-License-Identifier: Apache-2.0
// oriel_normal_map: tangent-space normal maps of games and glTF.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "overall_bump" = "normals" of a mia_material_x, both with the same bump_mode; or in a list
//   before a material, whose normal is then modified. The picture is a `vector texture`: its
//   numbers are used as stored, independent of the gamma of the scene. Declared by `$include
//   "oriel.mi"`.
// Model
//   (x, y, z) = 2 colour - 1, x and y times `factor`, in the frame of tangent, bitangent and front
//   normal, normalised. The tangent is in the direction of increasing u, perpendicular to the
//   normal. The bitangent is perpendicular to both, on the side of increasing v, so it is inverted
//   for mirrored coordinates. The directions are the bump basis of the texture space `space`, else
//   the derivatives of its coordinates. Green points up in the picture. Without texture space or
//   frame the normal is unchanged. Without `tex` the colour is `color`, which other shaders may
//   compute.
// Source:  glTF 2.0, 3.9.3 (normalTexture); the frame as in Mikkelsen, "Simulation of Wrinkled
//          Surfaces Revisited", 2008.
// Checked: NormalMap.* in tests/shader_binding, NormalMapOfModels.* in tests/imported
extern const ShaderSpec kOrielNormalMap;

}  // namespace oriel
