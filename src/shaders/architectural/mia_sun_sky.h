// SPDX-License-Identifier: Apache-2.0
// mia_physicalsun (a directional light) and mia_physicalsky (environment): use both together, with
// the same haze, shifts and units. mia_ciesky: grey standard skies for analysis.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMiaPhysicalSun;
extern const ShaderSpec kMiaPhysicalSky;
extern const ShaderSpec kMiaCieSky;

/// Toward the sun of a sky's parameters: that light's instance, else the direction, else straight
/// up. Checked: Sky.TheSunsInstanceBeatsTheDirection
Vec3 direction_to_sun(LightRef sun, const Vec3& direction, bool y_is_up, const World& world);

}  // namespace oriel
