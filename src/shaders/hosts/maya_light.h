// SPDX-License-Identifier: Apache-2.0
// Stand-ins for lights that Maya's translator writes: maya_ambientlight is missing, since Oriel has
// no light without a direction.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As maya_surface.h. Light is color x intensity, weaker with distance^decayRate; opaque blockers
//   leave shadowColor.

extern const ShaderSpec kMayaDirectionallight;
extern const ShaderSpec kMayaPointlight;
/// coneAngle is the whole inner cone in degrees; the outer one is the element's spread.
extern const ShaderSpec kMayaSpotlight;

}  // namespace oriel
