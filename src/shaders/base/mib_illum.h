// SPDX-License-Identifier: Apache-2.0
// mib_illum_lambert and mib_illum_phong: the classical surfaces.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibIllumLambert;
extern const ShaderSpec kMibIllumPhong;

}  // namespace oriel
