// SPDX-License-Identifier: Apache-2.0
// Sample of a lobe, and the conventions of all lobes.
#pragma once

#include "base/vec.h"

namespace oriel::bsdf {

// Conventions (all of src/bsdf)
//   Local shading frame, z = normal on the viewer's side. wo points to the viewer, wi to the light;
//   both are unit vectors away from the surface. Lobes return zero unless wo.z > 0; wi.z < 0 is the
//   other side of the surface.
//   Each lobe is a small value type with three functions:
//     float eval(wo, wi)   the value INCLUDING |cos wi|, white; the caller applies colour and
//     weight
//                          (Fresnel, curve) by view angle. Delta lobes: 0.
//     float pdf(wo, wi)    density of sample() per solid angle. Delta lobes: 0.
//     std::optional<LobeSample> sample(wo, u2, u1)   u2, u1 uniform in [0,1); unset if the sampled
//                                                    direction is below the horizon.
//   Radiance is not scaled by eta^2 on refraction, which is mental ray's convention.

/// A sampled direction.
struct LobeSample {
  Vec3 wi;
  float weight = 0;    ///< eval / pdf; for a delta lobe the share of the light in this direction
  float pdf = 0;       ///< per solid angle; 1 for a delta lobe
  bool delta = false;  ///< a delta direction, which no other strategy can sample
};

}  // namespace oriel::bsdf
