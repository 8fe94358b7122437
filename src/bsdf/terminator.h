// SPDX-License-Identifier: Apache-2.0
// Softens the shadow terminator of bump-mapped and smooth-shaded surfaces.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace oriel::bsdf {

/// Factor for diffuse light from wi: 1 if shading and geometric normal are equal, with a smooth
/// falloff to 0 at the geometric horizon.
///
/// Inputs:  ng, ns: unit geometric and shading normal; wi: unit, to the light; all in one frame.
/// Returns: 0..1, exactly 1 when ns == ng.
/// Source:  Chiang, Li, Burley, "Taming the Shadow Terminator", SIGGRAPH 2019 Talks.
/// Checked: Terminator.* in terminator_test.cpp
inline float soft_terminator(const Vec3& ng, const Vec3& ns, const Vec3& wi) {
  if (ns == ng) return 1;
  const float geometric = dot(wi, ng), shading = dot(wi, ns) * dot(ng, ns);
  if (geometric <= 0) return 0;
  if (shading <= geometric) return 1;
  const float g = geometric / shading;
  return g * (1 + g * (1 - g));
}

}  // namespace oriel::bsdf
