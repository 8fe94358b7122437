// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for lights that Maya's translator writes.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   As in maya_surface.h. Light is color x intensity, divided by distance^decayRate; opaque
//   occluders transmit shadowColor.

/// lightAngle is the full cone angle of the light source.
extern const ShaderSpec kMayaDirectionallight;
extern const ShaderSpec kMayaPointlight;
/// coneAngle is the full cone angle; the penumbra of penumbraAngle is outside of the cone, or
/// inside if negative.
extern const ShaderSpec kMayaSpotlight;
/// Multiplied by the cosine to the normal of the shape.
extern const ShaderSpec kMayaArealight, kMayaShapelight;
/// Its colour ramp and its volume are unsupported.
extern const ShaderSpec kMayaVolumelight;
/// Only surfaces that face its position are lit, because Oriel has no light without a direction.
/// ambientShade is the share of a point light; the rest does not depend on the angle.
extern const ShaderSpec kMayaAmbientlight;

}  // namespace oriel
