// SPDX-License-Identifier: Apache-2.0
// mib_lightmap_sample, mib_lightmap_write: irradiance of a surface, and light map baking.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Irradiance as the colour of a white Lambert surface: of the lights, and with `indirect` of
/// surfaces and environment. `flip` selects the front, the back, or both.
/// Source:  the vendor's page. In Oriel the shader may also be part of a material.
/// Checked: LightMaps.* in tests/analytic.
extern const ShaderSpec kMibLightmapSample;
/// Declared only: light maps are not baked. Rendering does not need them; a material with a light
/// map is reported (OR-RT-045) and rendered without it.
extern const ShaderSpec kMibLightmapWrite;

}  // namespace oriel
