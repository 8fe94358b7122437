// SPDX-License-Identifier: Apache-2.0
// The visible stand-in for a shader nobody has: magenta, as material and as value.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kStandIn;

}  // namespace oriel
