// SPDX-License-Identifier: Apache-2.0
// mia_physicalsun (a directional light) and mia_physicalsky (environment): use both together, with
// the same haze, shifts and units.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMiaPhysicalSun;
extern const ShaderSpec kMiaPhysicalSky;

}  // namespace oriel
