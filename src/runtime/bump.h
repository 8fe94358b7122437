// SPDX-License-Identifier: Apache-2.0
// Bump: normals from vectors in the spaces of the manual's bump modes.
#pragma once

#include <algorithm>

#include "runtime/shading_point.h"

namespace oriel {

/// A shading normal after one bump vector.
///
/// Inputs:  normal: unit, world; v: the vector; mode: 1-4 adds v to the normal, 5-8 replaces it, in
///          internal (= world), world, object, camera space. A null vector changes nothing: shaders
///          may move the normal themselves and return 0 0 0.
/// Returns: unit, world.
/// Source:  manual, "Bump Mapping".
Vec3 bump_normal(const ShadingPoint& point, const Vec3& normal, const Vec3& v, int mode);

/// The vector v by which bump_normal(point, from, v, mode) is `to`; null where they are the same
/// and the mode adds. Checked: BumpNormal.VectorsGiveTheNormalBack
Vec3 bump_vector(const ShadingPoint& point, const Vec3& from, const Vec3& to, int mode);

/// Turns the normal just enough that the viewer is on its front side: a bumped or interpolated
/// normal that looks away would shade black.
inline Vec3 facing_viewer(const Vec3& normal, const ShadingPoint& point) {
  /// Cosine below which a normal is lifted: a grazing view, not yet a division by zero.
  constexpr float kMinCosine = 1e-3f;
  const Vec3 wo = point.wo();
  const float cosine = dot(normal, wo);
  if (cosine >= kMinCosine) return normal;
  return normalize(normal + wo * (kMinCosine - cosine));
}

/// Turns the normal just enough that the mirrored view does not point into the flat triangle: what
/// glossy lobes lose below it would be a dark rim.
inline Vec3 reflecting_outward(const Vec3& normal, const ShadingPoint& point) {
  if (normal == point.geometric_normal) return normal;
  /// Least height of the mirrored view over the triangle, of that of the view itself: a guess that
  /// keeps about half of a lobe.
  constexpr float kHeight = 0.2f;
  const Vec3 wo = point.wo();
  const Vec3 mirrored = normal * (2 * dot(normal, wo)) - wo;
  const float least = kHeight * std::max(0.0f, dot(wo, point.geometric_normal));
  const float height = dot(mirrored, point.geometric_normal);
  if (height >= least) return normal;
  const Vec3 lifted = normalize(mirrored + point.geometric_normal * (least - height));
  return normalize(lifted + wo);
}

}  // namespace oriel
