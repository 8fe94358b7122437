// SPDX-License-Identifier: Apache-2.0
// The lists of cases, one for each file of shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_color_cases();  // shaders/base/mib_color.cpp
// Maya's, each of the files shaders/hosts/maya_*.cpp.
Cases maya_arithmetic_cases();  // and of conversions and surroundings
Cases maya_layers_cases();
Cases maya_light_cases();
Cases maya_ramp_cases();
Cases maya_surface_cases();
Cases maya_texture_cases();

inline std::vector<Cases (*)()> case_lists() {
  return {
      base_color_cases, maya_arithmetic_cases, maya_layers_cases,  maya_light_cases,
      maya_ramp_cases,  maya_surface_cases,    maya_texture_cases,
  };
}

}  // namespace oriel::effects
