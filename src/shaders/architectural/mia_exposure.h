// SPDX-License-Identifier: Apache-2.0
// mia_exposure_photographic and mia_exposure_simple: from scene colours to the display, as lens
// shaders (per sample) or output shaders (per pixel); and the photographic one undone.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMiaExposurePhotographic;
extern const ShaderSpec kMiaExposurePhotographicRev;
extern const ShaderSpec kMiaExposureSimple;

}  // namespace oriel
