// SPDX-License-Identifier: Apache-2.0
// Bump mapping: normals from vectors in the spaces of the manual's bump modes.
#pragma once

#include <algorithm>

#include "runtime/shading_point.h"

namespace oriel {

/// Applies a bump vector to a shading normal.
///
/// Inputs:  normal: unit, world; v: the vector; mode: 1-4 adds v to the normal, 5-8 replaces it, in
///          internal (= world), world, object, camera space. A null vector changes nothing: a
///          shader may change the normal itself and return 0 0 0.
/// Returns: unit, world.
/// Source:  manual, "Bump Mapping".
Vec3 bump_normal(const ShadingPoint& point, const Vec3& normal, const Vec3& v, int mode);

/// The vector v for which bump_normal(point, from, v, mode) is `to`; null if they are equal and the
/// mode adds. Checked: BumpNormal.VectorsGiveTheNormalBack
Vec3 bump_vector(const ShadingPoint& point, const Vec3& from, const Vec3& to, int mode);

/// Rotates the normal by the minimum angle that puts the viewer on its front side: a bumped or
/// interpolated normal that faces away would be black.
///
/// Inputs:  wo: unit, to the viewer.
inline Vec3 facing_viewer(const Vec3& normal, const Vec3& wo) {
  /// Minimum cosine between view and normal: a grazing view without division by zero.
  constexpr float kMinCosine = 1e-3f;
  const float cosine = dot(normal, wo);
  if (cosine >= kMinCosine) return normal;
  return normalize(normal + wo * (kMinCosine - cosine));
}
inline Vec3 facing_viewer(const Vec3& normal, const ShadingPoint& point) {
  return facing_viewer(normal, point.wo());
}

/// Rotates the normal by the minimum angle for which the mirrored view direction is above the
/// triangle: parts of glossy lobes below it would appear as a dark rim.
inline Vec3 reflecting_outward(const Vec3& normal, const ShadingPoint& point) {
  if (normal == point.geometric_normal) return normal;
  /// Minimum height of the mirrored view direction above the triangle, relative to that of the
  /// view; an estimate that keeps about half of a lobe.
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
