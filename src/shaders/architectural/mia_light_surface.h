// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMiaLightSurface;

}  // namespace oriel
