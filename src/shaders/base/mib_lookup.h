// SPDX-License-Identifier: Apache-2.0
// mib_lookup_spherical and mib_lookup_background: pictures as environments.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibLookupSpherical;
extern const ShaderSpec kMibLookupBackground;

}  // namespace oriel
