// SPDX-License-Identifier: Apache-2.0
// Additional layers of imported materials: bump and normal maps, sheen, clear coat.
#pragma once

#include "models/material_source.h"

namespace oriel::models {

/// Connects the normal or bump map of the model to a mia_material_x. It uses the first texture
/// space, so it has to precede other textures.
///
/// Model:   tangent-space normals use oriel_normal_map. Height maps use mib_bump_map2; white is
///          1/100 of the picture width above black, times the factor of the model. Formats define
///          no unit for heights; this value was chosen by eye. A height map with "normal" in its
///          name counts as a normal map, because OBJ has no separate statement for normal maps.
/// Returns: whether the material needs the package oriel.mi.
/// Source:  glTF 2.0, 3.9.3; mib_bump.h for the step of a hundredth.
/// Checked: ModelBump.*
bool add_bump(MaterialSource& source, ShaderCall& material);

/// Adds the sheen of the model, if it has one: an oriel_sheen over the material.
///
/// Source:  KHR_materials_sheen.
/// Checked: ModelSheen.*
ShaderCall sheened(MaterialSource& source, ShaderCall material);

/// Adds the clear coat of the model, if it has one: the material becomes a separate shader, and the
/// returned mib_glossy_reflection is layered over it.
///
/// Model:   base (1 - c F) + reflection c F, F = .04 + .96 (1 - cosine)^5 for the view direction;
///          the lobe width is the roughness squared. The coat uses the geometric normal.
/// Source:  KHR_materials_clearcoat.
/// Checked: ModelCoat.*, ClearCoatOfModels.* in tests/imported
ShaderCall coated(MaterialSource& source, ShaderCall material);

}  // namespace oriel::models
