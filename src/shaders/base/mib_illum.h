// SPDX-License-Identifier: Apache-2.0
// mib_illum_*: diffuse surfaces with the classical highlights of light sources.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibIllumLambert;
extern const ShaderSpec kMibIllumPhong;
/// Model:   mib_illum_cooktorr with one index; see bsdf/highlights.h. How bright mental ray's own
///          highlights are is not published: these keep energy.
extern const ShaderSpec kMibIllumBlinn;
extern const ShaderSpec kMibIllumCooktorr;
/// Slopes are 1 / shininess: that narrowness grows with it is the vendor's page, the rest a guess.
extern const ShaderSpec kMibIllumWard;
extern const ShaderSpec kMibIllumWardDeriv;
/// The fibre runs along the v of the texture.
extern const ShaderSpec kMibIllumHair;

}  // namespace oriel
