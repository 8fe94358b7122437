// SPDX-License-Identifier: Apache-2.0
// oriel_tex_vector: leaves a vector for the material behind it in the list.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   material "brushed" "oriel_tex_vector" ( "vector" = "flow" ) "mia_material_x" (
//   "anisotropy_channel" -4, ... ) end material: highlights stretch along the vector. Declared by
//   `$include "oriel.mi"`.
// Model
//   What shaders in C do by writing to state->tex before they call the material.
// Source:  manual 1.6.5, anisotropy_channel -4.
// Checked: Anisotropy.EachSourceTurnsReflectionsRefractionsAndHighlightsAlike
extern const ShaderSpec kOrielTexVector;

}  // namespace oriel
