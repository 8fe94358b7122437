// SPDX-License-Identifier: Apache-2.0
// Converts roughness to parameters of mia_material.
#pragma once

namespace oriel::models {

/// Glossiness of mia_material for the roughness of a glTF material: alpha = roughness squared. It
/// is clamped to 0 (roughest) above roughness 0.6 and to 1 (mirror) below 0.05.
/// Checked: ModelMaterial.GlossinessHasTheRoughnessOfTheModel
float gloss_of_roughness(float roughness);

/// Anisotropic lobe of a glTF material.
struct Brushed {
  float gloss = 0, ratio = 1;  ///< refl_gloss and anisotropy of mia_material
};
/// Model:   alpha is r^2 across the tangent and mix(r^2, 1, strength^2) along it; the result is
///          their mean and their ratio. Both are clamped to the range of mia_material: ratio 10,
///          and the mean of gloss 0.
/// Source:  KHR_materials_anisotropy, "Implementation".
/// Checked: ModelMaterial.AnisotropyHasTheWidthsOfTheExtension
Brushed brushed(float roughness, float strength);

}  // namespace oriel::models
