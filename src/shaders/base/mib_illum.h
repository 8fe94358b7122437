// SPDX-License-Identifier: Apache-2.0
// mib_illum_*: diffuse surfaces with classical highlights of light sources.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibIllumLambert;
extern const ShaderSpec kMibIllumPhong;
/// Model:   mib_illum_cooktorr with one index; see bsdf/highlights.h. The brightness of mental
///          ray's own highlights is unpublished; these are energy-conserving.
extern const ShaderSpec kMibIllumBlinn;
extern const ShaderSpec kMibIllumCooktorr;
/// Slopes are 1 / shininess. The vendor's page says that shininess makes highlights narrower; the
/// formula is a guess.
extern const ShaderSpec kMibIllumWard;
extern const ShaderSpec kMibIllumWardDeriv;
/// The fibre is along the v direction of the texture.
extern const ShaderSpec kMibIllumHair;

}  // namespace oriel
