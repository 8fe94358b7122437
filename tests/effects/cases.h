// SPDX-License-Identifier: Apache-2.0
// The lists of cases; each file *_cases.cpp says of which shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_color_cases();
Cases maya_arithmetic_cases();
Cases maya_layers_cases();
Cases maya_light_cases();
Cases maya_ramp_cases();
Cases maya_surface_cases();
Cases maya_texture_cases();
Cases other_lens_cases();
Cases other_max_light_cases();
Cases other_max_material_cases();
Cases other_max_texture_cases();
Cases other_oriel_cases();
Cases other_physics_cases();
Cases other_production_cases();
Cases other_volume_cases();

inline std::vector<Cases (*)()> case_lists() {
  return {
      base_color_cases,
      maya_arithmetic_cases,
      maya_layers_cases,
      maya_light_cases,
      maya_ramp_cases,
      maya_surface_cases,
      maya_texture_cases,
      other_lens_cases,
      other_max_light_cases,
      other_max_material_cases,
      other_max_texture_cases,
      other_oriel_cases,
      other_physics_cases,
      other_production_cases,
      other_volume_cases,
  };
}

}  // namespace oriel::effects
