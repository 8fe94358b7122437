// SPDX-License-Identifier: Apache-2.0
// What every lobe answers when asked for a direction, and the conventions all lobes share.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

// Conventions (all of src/bsdf)
//   Local shading frame, z = normal on the viewer's side. wo points to the viewer, wi to the light;
//   both unit, both away from the surface. wo.z > 0, else a lobe answers nothing; wi.z < 0 is the
//   other side of the surface.
//   Each lobe is a small value with three functions:
//     float eval(wo, wi)   the lobe's value INCLUDING |cos wi|, white; the caller applies colour
//                          and level (Fresnel, curve) per view angle. Delta lobes: 0.
//     float pdf(wo, wi)    density of sample() per solid angle. Delta lobes: 0.
//     std::optional<LobeSample> sample(wo, u2, u1)   u2, u1 uniform in [0,1); nothing when the draw
//                          is lost below the horizon.
//   Radiance is not scaled by eta^2 on refraction, which is mental ray's convention.

/// A sampled direction.
struct LobeSample {
  Vec3 wi;
  float weight = 0;    ///< eval / pdf; of a delta lobe the share of the light that goes this way
  float pdf = 0;       ///< per solid angle; 1 for a delta lobe
  bool delta = false;  ///< the only direction possible: no other strategy can find it
};

}  // namespace oriel::bsdf
