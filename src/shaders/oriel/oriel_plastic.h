// SPDX-License-Identifier: Apache-2.0
// oriel_plastic: a diffuse surface under a rough dielectric boundary.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   As a material where the highlights of low lights count: floors and walls seen at grazing
//   angles. `mia_material_x` weighs a blurred reflection by the angle of the view; here each facet
//   reflects by its own angle. The Blender extension writes it for Principled BSDF. Declared by
//   `$include "oriel.mi"`.
// Model
//   base + diffuse + reflection. Reflection: bsdf::FacetReflection with alpha = roughness^2.
//   Diffuse: bsdf::BurleyDiffuse with `retro_reflective`, else Lambert. `conserve` removes the
//   albedo of the reflection from both others: albedo_0 + (albedo_90 - albedo_0) (1 -
//   cosine)^curve.
// Source:  Burley 2012 and Walter et al. 2007, see bsdf/burley_diffuse.h, bsdf/facet_reflection.h.
// Checked: tests/effects; tests/blender against Cycles
extern const ShaderSpec kOrielPlastic;

}  // namespace oriel
