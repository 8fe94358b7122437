// SPDX-License-Identifier: Apache-2.0
// oriel_tex_vector: sets a vector for the next material in the list.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   material "brushed" "oriel_tex_vector" ( "vector" = "flow" ) "mia_material_x" (
//   "anisotropy_channel" -4, ... ) end material: stretches highlights along the vector. Declared by
//   `$include "oriel.mi"`.
// Model
//   Equivalent to a C shader that writes state->tex before it calls the material.
// Source:  manual 1.6.5, anisotropy_channel -4.
// Checked: Anisotropy.EachSourceTurnsReflectionsRefractionsAndHighlightsAlike
extern const ShaderSpec kOrielTexVector;

}  // namespace oriel
