// SPDX-License-Identifier: Apache-2.0
// What materials of models have beside their scattering: normals turned by pictures, a clear coat.
#pragma once

#include "models/material_source.h"

namespace oriel::models {

/// Turns the normals of a mia_material_x as the model's pictures say. Asks for the first texture
/// space, so it comes before all other pictures.
///
/// Model:   tangent-space normals through oriel_normal_map; heights through mib_bump_map2, where
///          white over black is as high as the picture is wide over a hundred, times the model's
///          factor: formats give no unit, and this looks right. A picture of heights whose name
///          says "normal" is one of normals: OBJ has no other place for them.
/// Returns: whether it needs the package oriel.mi.
/// Source:  glTF 2.0, 3.9.3; mib_bump.h for the step of a hundredth.
/// Checked: ModelBump.*
bool add_bump(MaterialSource& source, ShaderCall& material);

/// Lays a clear coat over the material where the model has one: the material goes into a shader of
/// its own, and a mib_glossy_reflection over it is returned.
///
/// Model:   base (1 - c F) + reflection c F, F = .04 + .96 (1 - cosine)^5 for the view, as wide as
///          the roughness squared; the coat's normal is that of the geometry.
/// Source:  KHR_materials_clearcoat.
/// Checked: ModelCoat.*, ClearCoatOfModels.* in tests/imported
ShaderCall coated(MaterialSource& source, ShaderCall material);

}  // namespace oriel::models
