// SPDX-License-Identifier: Apache-2.0
// oriel_normal_map: pictures of normals, as games and glTF have them.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "overall_bump" = "normals" of a mia_material_x, both with the same bump_mode; or in a list
//   before a material, which is then bumped. The picture is a `vector texture`: its numbers are
//   read as they are stored, whatever the scene's gamma. Declared by `$include "oriel.mi"`.
// Model
//   (x, y, z) = 2 colour - 1, x and y times `factor`, in the frame of tangent, bitangent and front
//   normal, of unit length at the end. The tangent runs along growing u, square to the normal; the
//   bitangent is square to both, on the side of growing v, so mirrored coordinates turn it over.
//   The directions are the bump basis of the first texture space, or else the derivatives of its
//   coordinates. Green points up in the picture. Where there is no space, no picture or no frame,
//   the normal stays.
// Source:  glTF 2.0, 3.9.3 (normalTexture); the frame as in Mikkelsen, "Simulation of Wrinkled
//          Surfaces Revisited", 2008.
// Checked: NormalMap.* in tests/shader_binding, NormalMapOfModels.* in tests/imported
extern const ShaderSpec kOrielNormalMap;

}  // namespace oriel
