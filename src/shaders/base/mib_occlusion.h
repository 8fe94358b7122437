// SPDX-License-Identifier: Apache-2.0
// mib_amb_occlusion, mib_fast_occlusion, mib_fg_occlusion, mib_bent_normal_env: how open it is
// around a point.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Rays are cosine-weighted about the normal, or the mirrored view, within a cone: spread 1 is the
//   hemisphere. Each evaluation takes a few of the rays asked for: counts are for the pixel, whose
//   samples bring the rest. A hit closes (1 - distance / max_distance)^falloff of its ray. Where
//   the scene may not be asked (ShadingPoint::tracer) all is open.
// Source:  public declarations and pages; the weight of rays and the shape of the fade are guesses.
// Checked: OcclusionNodes.* in tests/analytic.

extern const ShaderSpec kMibAmbOcclusion;
/// The same without a cache of points; its spread is the cosine of the cone's half angle, from the
/// hemisphere at 0, narrowed by spread_exp.
extern const ShaderSpec kMibFastOcclusion;
/// With final gathering on, occlusion of the hemisphere at any distance as grey.
extern const ShaderSpec kMibFgOcclusion;
/// Environment in the direction that a colour encodes, times occlusion and strength.
extern const ShaderSpec kMibBentNormalEnv;

}  // namespace oriel
