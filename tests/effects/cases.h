// SPDX-License-Identifier: Apache-2.0
// The lists of cases, one for each file of shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_color_cases();      // shaders/base/mib_color.cpp
Cases base_bump_cases();       // shaders/base/mib_bump.cpp
Cases base_glossy_cases();     // shaders/base/mib_glossy.cpp
Cases base_illum_cases();      // shaders/base/mib_illum.cpp
Cases base_lens_cases();       // shaders/base/mib_lens.cpp, mib_ray_marcher.cpp
Cases base_light_cases();      // shaders/base/mib_light*.cpp, mib_shadow.cpp
Cases base_lookup_cases();     // shaders/base/mib_lookup.cpp, mib_lookup_cube.cpp
Cases base_occlusion_cases();  // shaders/base/mib_occlusion.cpp
Cases base_pattern_cases();    // shaders/base/mib_texture_procedural.cpp
Cases base_ray_cases();        // shaders/base/mib_ray.cpp
Cases base_texture_cases();    // shaders/base/mib_texture.cpp, mib_texture_filter.cpp

inline std::vector<Cases (*)()> case_lists() {
  return {
      base_color_cases,   base_bump_cases,  base_glossy_cases,  base_illum_cases,
      base_lens_cases,    base_light_cases, base_lookup_cases,  base_occlusion_cases,
      base_pattern_cases, base_ray_cases,   base_texture_cases,
  };
}

}  // namespace oriel::effects
