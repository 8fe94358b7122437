// SPDX-License-Identifier: Apache-2.0
// mib_light_point, mib_light_spot, mib_light_infinite and physical_light.
//
// The mib lights have no distance falloff unless `atten` is on (linear from start to stop);
// physical_light uses the exponent of the light element, 2 = inverse square.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibLightPoint;
extern const ShaderSpec kMibLightSpot;
extern const ShaderSpec kMibLightInfinite;
extern const ShaderSpec kPhysicalLight;

}  // namespace oriel
