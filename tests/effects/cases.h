// SPDX-License-Identifier: Apache-2.0
// Lists of cases; each file *_cases.cpp names its shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_bump_cases();
Cases base_color_cases();
Cases base_glossy_cases();
Cases base_illum_cases();
Cases base_lens_cases();
Cases base_light_cases();
Cases base_lookup_cases();
Cases base_occlusion_cases();
Cases base_pattern_cases();
Cases base_ray_cases();
Cases base_texture_cases();
Cases maya_arithmetic_cases();
Cases maya_layers_cases();
Cases maya_light_cases();
Cases maya_ramp_cases();
Cases maya_surface_cases();
Cases maya_texture_cases();
Cases mia_blur_cases();
Cases mia_exposure_cases();
Cases mia_light_cases();
Cases mia_roundcorners_cases();
Cases mia_sky_cases();
Cases mia_sun_cases();
Cases other_lens_cases();
Cases other_max_light_cases();
Cases other_max_material_cases();
Cases other_max_texture_cases();
Cases other_oriel_cases();
Cases oriel_node_cases();
Cases oriel_texture_cases();
Cases other_physics_cases();
Cases other_production_cases();
Cases other_volume_cases();
Cases photon_slot_cases();
Cases subsurface_cases();

inline std::vector<Cases (*)()> case_lists() {
  return {
      base_bump_cases,         base_color_cases,
      base_glossy_cases,       base_illum_cases,
      base_lens_cases,         base_light_cases,
      base_lookup_cases,       base_occlusion_cases,
      base_pattern_cases,      base_ray_cases,
      base_texture_cases,      maya_arithmetic_cases,
      maya_layers_cases,       maya_light_cases,
      maya_ramp_cases,         maya_surface_cases,
      maya_texture_cases,      mia_blur_cases,
      mia_exposure_cases,      mia_light_cases,
      mia_roundcorners_cases,  mia_sky_cases,
      mia_sun_cases,           other_lens_cases,
      other_max_light_cases,   other_max_material_cases,
      other_max_texture_cases, other_oriel_cases,
      oriel_node_cases,        other_physics_cases,
      other_production_cases,  other_volume_cases,
      photon_slot_cases,       subsurface_cases,
      oriel_texture_cases,
  };
}

}  // namespace oriel::effects
