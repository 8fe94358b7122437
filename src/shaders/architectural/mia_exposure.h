// SPDX-License-Identifier: Apache-2.0
// mia_exposure_photographic and mia_exposure_simple: tone mapping as lens shaders (per sample) or
// output shaders (per pixel); and the inverse of the photographic exposure.
#pragma once

#include "runtime/shader_spec.h"
#include "tone/exposure.h"

namespace oriel {

extern const ShaderSpec kMiaExposurePhotographic;
extern const ShaderSpec kMiaExposurePhotographicRev;
extern const ShaderSpec kMiaExposureSimple;

/// Parameters of shaders that use the parameter names of the photographic exposure.
template <class P>
lens::PhotographicParameters photographic_parameters(const P& p) {
  return {.cm2_factor = p.cm2_factor,
          .whitepoint = rgb(p.whitepoint),
          .film_iso = p.film_iso,
          .camera_shutter = p.camera_shutter,
          .f_number = p.f_number,
          .vignetting = p.vignetting,
          .burn_highlights = p.burn_highlights,
          .crush_blacks = p.crush_blacks,
          .saturation = p.saturation,
          .gamma = p.gamma};
}

}  // namespace oriel
