// SPDX-License-Identifier: Apache-2.0
// Barycentric coordinates of a point.
#pragma once

#include "base/vec.h"

namespace oriel::geom {

/// Barycentric coordinates of the point projected onto the plane of the triangle. Their sum is 1;
/// outside the triangle some are negative. A triangle without area returns (1, 0, 0).
/// Checked: Barycentric.*
inline Vec3 barycentric_weights(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 e1 = b - a, e2 = c - a, d = point - a;
  const Vec3 n = cross(e1, e2);
  const float area = dot(n, n);
  if (!(area > 0)) return Vec3(1, 0, 0);
  const float wb = dot(cross(d, e2), n) / area, wc = dot(cross(e1, d), n) / area;
  return Vec3(1 - wb - wc, wb, wc);
}

}  // namespace oriel::geom
