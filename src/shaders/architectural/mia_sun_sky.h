// SPDX-License-Identifier: Apache-2.0
// mia_physicalsun (a directional light) and mia_physicalsky (environment): use both with the same
// haze, shifts and units. mia_ciesky: grey CIE standard skies.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMiaPhysicalSun;
extern const ShaderSpec kMiaPhysicalSky;
extern const ShaderSpec kMiaCieSky;

/// Direction to the sun: that of the light instance, else `direction`, else straight up. Checked:
/// Sky.SunInstanceOverridesTheDirection
Vec3 direction_to_sun(LightRef sun, const Vec3& direction, bool y_is_up, const World& world);

}  // namespace oriel
