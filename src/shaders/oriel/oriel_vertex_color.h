// SPDX-License-Identifier: Apache-2.0
// oriel_vertex_color: vertex colours of a mesh.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "diffuse" = "colours" of a material whose objects store colours as a texture space: u, v and w
//   are linear red, green and blue. Declared by `$include "oriel.mi"`.
// Model
//   `color` times the coordinates of the space, interpolated linearly; alpha times the first
//   coordinate of `alpha_space`. Missing texture spaces count as 1.
// Source:  glTF 2.0, 3.9.2 (COLOR_0 multiplies the base colour).
// Checked: VertexColor.* in tests/shader_binding, ColoursOfModels.* in tests/imported
extern const ShaderSpec kOrielVertexColor;

}  // namespace oriel
