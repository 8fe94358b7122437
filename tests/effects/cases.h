// SPDX-License-Identifier: Apache-2.0
// The lists of cases, one for each file of shaders.
#pragma once

#include "effects.h"

namespace oriel::effects {

Cases base_color_cases();  // shaders/base/mib_color.cpp
// shaders/architectural
Cases mia_blur_cases();
Cases mia_exposure_cases();
Cases mia_light_cases();
Cases mia_roundcorners_cases();
Cases mia_sky_cases();
Cases mia_sun_cases();

inline std::vector<Cases (*)()> case_lists() {
  return {base_color_cases,       mia_blur_cases, mia_exposure_cases, mia_light_cases,
          mia_roundcorners_cases, mia_sky_cases,  mia_sun_cases};
}

}  // namespace oriel::effects
