// SPDX-License-Identifier: Apache-2.0
// Orthonormal frames, such as the local shading frame with z along the normal.
#pragma once

#include "base/vec.h"

namespace oriel {

/// Right-handed orthonormal basis; local z is `n`.
struct Frame {
  Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  Frame() = default;
  Frame(const Vec3& s_, const Vec3& t_, const Vec3& n_) : s(s_), t(t_), n(n_) {}

  /// Any frame around the unit vector `n`.
  /// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
  explicit Frame(const Vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    s = Vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = Vec3(b, sign + n.y * n.y * a, -n.y);
  }

  /// Frame around the unit vector `normal` with s as close to `tangent` as possible; an arbitrary s
  /// if the tangent is null or parallel to the normal.
  static Frame along(const Vec3& normal, const Vec3& tangent) {
    const Vec3 s = tangent - normal * dot(normal, tangent);
    const float len2 = dot(s, s);
    if (!(len2 > 1e-12f * dot(tangent, tangent))) return Frame(normal);
    const Vec3 unit = s * (1 / std::sqrt(len2));
    return Frame(unit, cross(normal, unit), normal);
  }

  Vec3 to_local(const Vec3& v) const { return Vec3(dot(v, s), dot(v, t), dot(v, n)); }
  Vec3 to_world(const Vec3& v) const {
    return Vec3(fma(s.x, v.x, fma(t.x, v.y, n.x * v.z)), fma(s.y, v.x, fma(t.y, v.y, n.y * v.z)),
                fma(s.z, v.x, fma(t.z, v.y, n.z * v.z)));
  }
};

}  // namespace oriel
