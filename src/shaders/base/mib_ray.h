// SPDX-License-Identifier: Apache-2.0
// mib_reflect, mib_refract, mib_transparency, mib_opacity, mib_continue, mib_twosided,
// mib_dielectric, mib_refraction_index: rays blended over another material.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   input x (1 - k) + traced x k per channel; alpha is ignored. `input` is a visible colour or
//   another material. Where k exceeds 1 the input has no weight.
// Source:  the vendor's pages on the shaders.
// Checked: RayNodes.* in tests/analytic.

extern const ShaderSpec kMibReflect;
/// `ior` is the index of the entered side divided by that of the other side.
extern const ShaderSpec kMibRefract;
extern const ShaderSpec kMibTransparency;
/// Continues as if there were no surface: the opacity that all channels share is a cut-out, the
/// rest is transmitted like through a thin wall.
extern const ShaderSpec kMibOpacity;
extern const ShaderSpec kMibContinue;
extern const ShaderSpec kMibTwosided;
/// Only the refraction of a dielectric, as on the vendor's page; another source adds Fresnel
/// reflection. `absorb` is interpreted as the absorption of the solid behind the surface.
extern const ShaderSpec kMibDielectric;
extern const ShaderSpec kMibRefractionIndex;

}  // namespace oriel
