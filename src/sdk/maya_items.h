// SPDX-License-Identifier: Apache-2.0
// State items of Maya's interface, set by the last light sample of the thread.
#pragma once

#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

/// MBSI_LIGHTDIFFUSE, MBSI_LIGHTSPECULAR. Shaders keep the addresses while they run.
struct LightItems {
  miBoolean diffuse = miTRUE, specular = miTRUE;
};
LightItems& light_items();

}  // namespace oriel::sdk
