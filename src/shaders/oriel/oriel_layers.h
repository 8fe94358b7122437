// SPDX-License-Identifier: Apache-2.0
// oriel_sheen and oriel_thin_film: layers of cloth and of films.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   "oriel_sheen" as a material, with another material as `base_material`. "oriel_thin_film" as
//   "refl_color" of a mia_material_x whose reflectivity does not depend on the angle
//   (`brdf_0_degree_refl` 1). Both are declared by `$include "oriel.mi"`.

/// Model:   base x (1 - m E) + colour x sheen, with m the largest channel of the colour and E the
///          albedo of the sheen seen by the viewer: no light is gained. alpha is the roughness
///          squared.
/// Source:  KHR_materials_sheen.
/// Checked: Sheen.*; SheenOfModels.* in tests/imported
extern const ShaderSpec kOrielSheen;

/// Model:   the reflectance at the angle of the viewer: bsdf::thin_film_color, mixed by `factor`
///          with Schlick's approximation for the base.
/// Source:  KHR_materials_iridescence.
/// Checked: ThinFilm.*; tests/effects
extern const ShaderSpec kOrielThinFilm;

}  // namespace oriel
