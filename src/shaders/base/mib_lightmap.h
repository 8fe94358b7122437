// SPDX-License-Identifier: Apache-2.0
// mib_lightmap_sample, mib_lightmap_write: light of a surface, and what paints it into a texture.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Light that falls on the surface, as the colour of a white Lambert surface: of the lights, and
/// with `indirect` that of surfaces and environment. `flip`: on the front, the back, or both.
/// Source:  the vendor's page. Here it may stand in a material as well.
/// Checked: LightMaps.* in tests/analytic.
extern const ShaderSpec kMibLightmapSample;
/// Known by name and parameters alone: light maps are not made. Frames are lit as a whole, so a
/// picture needs none; a material that has one is reported (OR-RT-045) and rendered without.
extern const ShaderSpec kMibLightmapWrite;

}  // namespace oriel
