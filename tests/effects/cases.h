// SPDX-License-Identifier: Apache-2.0
// The lists of cases, one for each file of shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_color_cases();          // shaders/base/mib_color.cpp
Cases other_max_light_cases();     // shaders/hosts/max_lights.cpp
Cases other_max_material_cases();  // shaders/hosts/max_materials.cpp
Cases other_max_texture_cases();   // shaders/hosts/max_textures.cpp
Cases other_lens_cases();          // shaders/oriel/oriel_lens.cpp
Cases other_oriel_cases();         // the rest of shaders/oriel
Cases other_production_cases();    // shaders/hosts/production.cpp
Cases other_physics_cases();       // shaders/physics/dgs_material.cpp
Cases other_volume_cases();        // shaders/physics/parti_volume.cpp
// shaders/architectural
Cases mia_blur_cases();
Cases mia_exposure_cases();
Cases mia_light_cases();
Cases mia_roundcorners_cases();
Cases mia_sky_cases();
Cases mia_sun_cases();

inline std::vector<Cases (*)()> case_lists() {
  return {
      base_color_cases,        other_max_light_cases, other_max_material_cases,
      other_max_texture_cases, other_lens_cases,      other_oriel_cases,
      other_production_cases,  other_physics_cases,   other_volume_cases,
      mia_blur_cases,          mia_exposure_cases,    mia_light_cases,
      mia_roundcorners_cases,  mia_sky_cases,         mia_sun_cases,
  };
}

}  // namespace oriel::effects
