// SPDX-License-Identifier: Apache-2.0
// oriel_facing: a weight by the angle between normal and view.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Weights of mixed colours and materials that depend on the view: reflectance, edges, back sides.
//   Declared by `$include "oriel.mi"`.
// Model
//   c = |cosine between shading normal and view|. Mode 0: c. Mode 1: reflectance of a dielectric of
//   index `ior`, seen from inside on back sides. Mode 2: 1 - c^e with e = 2 blend, or
//   1 / (2 - 2 blend) above 0.5. Mode 3: (1 - c)^5. Mode 4: 1 on back sides, else 0.
// Source:  Fresnel's equations; Blender's manual, Layer Weight Node; Schlick 1994.
// Checked: tests/effects; tests/blender against Cycles
extern const ShaderSpec kOrielFacing;

}  // namespace oriel
