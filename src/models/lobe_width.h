// SPDX-License-Identifier: Apache-2.0
// Roughness of models as mia_material's parameters.
#pragma once

namespace oriel::models {

/// mia_material's glossiness that has the roughness of a glTF material: alpha = roughness squared.
/// Above roughness 0.6 it is 0, the roughest there is; below 0.05 it is 1, a mirror.
/// Checked: ModelMaterial.GlossinessHasTheRoughnessOfTheModel
float gloss_of_roughness(float roughness);

/// Lobe of a glTF material whose reflections are stretched.
struct Brushed {
  float gloss = 0, ratio = 1;  ///< of mia_material: refl_gloss, anisotropy
};
/// Model:   roughness r^2 across the tangent, mix(r^2, 1, strength^2) along it: their mean
///          and their ratio. It stays within what mia_material can do, 10 and the mean of gloss 0.
/// Source:  KHR_materials_anisotropy, "Implementation".
/// Checked: ModelMaterial.AnisotropyHasTheWidthsOfTheExtension
Brushed brushed(float roughness, float strength);

}  // namespace oriel::models
