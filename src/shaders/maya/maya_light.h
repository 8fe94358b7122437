// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for lights that Maya's translator writes.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As maya_surface.h. Light is color x intensity, weaker with distance^decayRate; opaque blockers
//   leave shadowColor.

/// lightAngle is the whole cone the light comes from.
extern const ShaderSpec kMayaDirectionallight;
extern const ShaderSpec kMayaPointlight;
/// coneAngle is the whole cone; past it, or before it, light fades over penumbraAngle.
extern const ShaderSpec kMayaSpotlight;
/// Times the cosine to the shape's normal.
extern const ShaderSpec kMayaArealight, kMayaShapelight;
/// Its colour ramp and its volume are not known to Oriel.
extern const ShaderSpec kMayaVolumelight;
/// Only what faces its place is lit: Oriel has no light without a direction. Of that, ambientShade
/// is light of a point and the rest is as bright whatever the angle.
extern const ShaderSpec kMayaAmbientlight;

}  // namespace oriel
