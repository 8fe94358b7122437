// SPDX-License-Identifier: Apache-2.0
// oriel_vertex_color: colours that the corners of a mesh have.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "diffuse" = "colours" of a material whose objects carry colours as a texture space: u, v and w
//   are red, green and blue, as light. Declared by `$include "oriel.mi"`.
// Model
//   `color` times the space's coordinates, straight between corners; alpha times the first
//   coordinate of `alpha_space`. What a surface has no space for is taken as 1.
// Source:  glTF 2.0, 3.9.2 (COLOR_0 multiplies the base colour).
// Checked: VertexColor.* in tests/shader_binding, ColoursOfModels.* in tests/imported
extern const ShaderSpec kOrielVertexColor;

}  // namespace oriel
