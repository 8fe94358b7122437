// SPDX-License-Identifier: Apache-2.0
#include "runtime/bump.h"

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
    // A replaced normal refers to the front side; the returned one faces the viewer.
    return point.back_side ? -n : n;
  }
  const Vec3 sum = normal + n;
  return dot(sum, sum) > 0 ? normalize(sum) : normal;
}

Vec3 bump_vector(const ShadingPoint& point, const Vec3& from, const Vec3& to, int mode) {
  if (mode < 1 || mode > 8) return Vec3(0);
  Vec3 v = to - from;
  if (mode >= 5) v = point.back_side ? -to : to;
  switch ((mode - 1) % 4) {
    case 2:
      return point.to_world ? transform_normal(v, *point.to_world) : v;
    case 3:
      return point.world ? transform_normal(v, point.world->camera.to_world) : v;
    default:
      return v;
  }
}

}  // namespace oriel
