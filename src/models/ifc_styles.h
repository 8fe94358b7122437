// SPDX-License-Identifier: Apache-2.0
// Surface styles that IFC files define by the materials of products.
#pragma once

#include "models/step_text.h"

namespace oriel::models {

/// Adds a styled item for each shape of a product that has none, because assimp reads only those.
///
/// Model:   the style is that of the first operand of a boolean; else that of the product's
///          material, or of the material of its type. Of layers, profiles and lists the first
///          material with a style is used; of constituents the one whose name is that of the
///          shape's aspect. A material without a style becomes a grey style of its name.
/// Source:  IFC4 ADD2 TC1 (buildingSMART), IfcMaterialResource, IfcPresentationAppearanceResource.
/// Checked: IfcText.StylesOfMaterials*, ImportedIfc.*
void add_styles_of_materials(StepFile& file);

}  // namespace oriel::models
