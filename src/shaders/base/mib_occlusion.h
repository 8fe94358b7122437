// SPDX-License-Identifier: Apache-2.0
// mib_amb_occlusion, mib_fast_occlusion, mib_fg_occlusion, mib_bent_normal_env: ambient occlusion.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Conventions
//   Rays are cosine-weighted about the normal, or about the mirrored view, in a cone; spread 1 is
//   the hemisphere. The number of rays is per pixel: each evaluation traces a few of them, and the
//   samples of the pixel provide the rest. A hit occludes (1 - distance / max_distance)^falloff of
//   its ray. Without a tracer (ShadingPoint::tracer) nothing is occluded.
// Source:  public declarations and pages; ray weights and the shape of the falloff are guesses.
// Checked: OcclusionNodes.* in tests/analytic.

extern const ShaderSpec kMibAmbOcclusion;
/// Same without a point cache. Its spread is the cosine of the half angle of the cone (0 is the
/// hemisphere), narrowed by spread_exp.
extern const ShaderSpec kMibFastOcclusion;
/// If final gathering is on, occlusion of the hemisphere at any distance, in grey.
extern const ShaderSpec kMibFgOcclusion;
/// Environment in the direction encoded in a colour, times occlusion and strength.
extern const ShaderSpec kMibBentNormalEnv;

}  // namespace oriel
