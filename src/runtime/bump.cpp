// SPDX-License-Identifier: Apache-2.0
#include "runtime/bump.h"

#include <algorithm>

#include "runtime/world.h"

namespace oriel {

Vec3 bump_normal(const ShadingPoint& point, const Vec3& normal, const Vec3& v, int mode) {
  if (v == Vec3(0) || mode < 1 || mode > 8) return normal;
  Vec3 n = v;
  switch ((mode - 1) % 4) {
    case 2:
      if (point.to_object) n = transform_normal(v, *point.to_object);
      break;
    case 3:
      if (point.world) n = transform_normal(v, point.world->camera.to_camera);
      break;
    default:
      break;
  }
  if (mode >= 5) {
    n = normalize(n);
    // A replaced normal is that of the front; the caller's faces the viewer.
    return point.back_side ? -n : n;
  }
  const Vec3 sum = normal + n;
  return dot(sum, sum) > 0 ? normalize(sum) : normal;
}

Vec3 facing_viewer(const Vec3& normal, const ShadingPoint& point) {
  /// Cosine below which a normal is lifted: a grazing view, not yet a division by zero.
  constexpr float kLeastCosine = 1e-3f;
  const Vec3 wo = point.wo();
  const float cosine = dot(normal, wo);
  if (cosine >= kLeastCosine) return normal;
  return normalize(normal + wo * (kLeastCosine - cosine));
}

Vec3 reflecting_outward(const Vec3& normal, const ShadingPoint& point) {
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
