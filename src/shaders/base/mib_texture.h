// SPDX-License-Identifier: Apache-2.0
// mib_texture_vector, mib_texture_remap, mib_texture_lookup: coordinates and texture lookups.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibTextureVector;
extern const ShaderSpec kMibTextureRemap;
extern const ShaderSpec kMibTextureLookup;

}  // namespace oriel
