// SPDX-License-Identifier: Apache-2.0
// mib_reflect, mib_refract, mib_transparency, mib_opacity, mib_continue, mib_twosided,
// mib_dielectric, mib_refraction_index: rays blended over another material.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   input x (1 - k) + traced x k, by channel; alpha is left out. `input` is a colour that is seen,
//   or another material. What is above 1 in k leaves nothing of the input.
// Source:  the vendor's pages of the shaders.
// Checked: RayNodes.* in tests/analytic.

extern const ShaderSpec kMibReflect;
/// `ior` is that of the side entered over that of the side left.
extern const ShaderSpec kMibRefract;
extern const ShaderSpec kMibTransparency;
/// Continues as if there were no surface: what all channels let pass is a cut-out, the rest goes
/// through as through a thin wall.
extern const ShaderSpec kMibOpacity;
extern const ShaderSpec kMibContinue;
extern const ShaderSpec kMibTwosided;
/// The refracting part of a dielectric alone, as the vendor's page has it; another source gives it
/// Fresnel reflection. `absorb` is taken for what the solid behind the surface absorbs.
extern const ShaderSpec kMibDielectric;
extern const ShaderSpec kMibRefractionIndex;

}  // namespace oriel
