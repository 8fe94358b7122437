// SPDX-License-Identifier: Apache-2.0
#include "geom/shapes.h"

#include <algorithm>

#include "base/frame.h"
#include "base/math.h"

namespace oriel::geom {

namespace {

struct PlaneHit {
  float t, a, b;  // org + t d = center + a u + b v
  Vec3 n;
};

// Uses only positions relative to the center, to keep precision far from the origin.
std::optional<PlaneHit> intersect_plane(const Vec3& center, const Vec3& u, const Vec3& v,
                                        const Vec3& org, const Vec3& d, float tnear, float tfar) {
  const Vec3 n = cross(u, v);
  const float area2 = dot(n, n), facing = dot(n, d);
  if (!(area2 > 0) || facing == 0) return {};
  const Vec3 from_center = org - center;
  const float t = -dot(n, from_center) / facing;
  if (!(t > tnear && t < tfar)) return {};
  const Vec3 local = from_center + d * t;
  return PlaneHit{t, dot(cross(local, v), n) / area2, dot(cross(u, local), n) / area2,
                  n * (1 / std::sqrt(area2))};
}

float turn_fraction(float y, float x) {
  const float angle = math::atan2(y, x) / kTwoPi;
  return angle < 0 ? angle + 1 : angle;
}

// Ascending roots of |f + t d|^2 = r^2; `miss` is the part of f perpendicular to d, which gives the
// discriminant without cancellation.
std::optional<Vec2> circle_roots(const Vec3& f, const Vec3& d, float radius) {
  const float a = dot(d, d), b = -dot(f, d);
  if (!(a > 0)) return {};
  const Vec3 miss = f + d * (b / a);
  const float room = radius * radius - dot(miss, miss);
  if (!(room >= 0 && radius > 0)) return {};
  const float c = dot(f, f) - radius * radius;
  const float q = b + std::copysign(std::sqrt(a * room), b);
  if (q == 0) return Vec2(0);
  const float t0 = c / q, t1 = q / a;
  return Vec2(std::min(t0, t1), std::max(t0, t1));
}

}  // namespace

std::optional<ShapeHit> intersect(const Rectangle& shape, const Vec3& org, const Vec3& d,
                                  float tnear, float tfar) {
  const auto hit = intersect_plane(shape.center, shape.edge_u, shape.edge_v, org, d, tnear, tfar);
  if (!hit || std::abs(hit->a) > 1 || std::abs(hit->b) > 1) return {};
  return ShapeHit{hit->t, shape.center + shape.edge_u * hit->a + shape.edge_v * hit->b, hit->n,
                  Vec2((1 + hit->a) / 2, (1 + hit->b) / 2)};
}

std::optional<ShapeHit> intersect(const Disc& shape, const Vec3& org, const Vec3& d, float tnear,
                                  float tfar) {
  const auto hit =
      intersect_plane(shape.center, shape.radius_u, shape.radius_v, org, d, tnear, tfar);
  if (!hit) return {};
  const float r2 = sqr(hit->a) + sqr(hit->b);
  if (!(r2 <= 1)) return {};
  return ShapeHit{hit->t, shape.center + shape.radius_u * hit->a + shape.radius_v * hit->b, hit->n,
                  Vec2(std::sqrt(r2), turn_fraction(hit->b, hit->a))};
}

std::optional<ShapeHit> intersect(const Sphere& shape, const Vec3& org, const Vec3& d, float tnear,
                                  float tfar) {
  const Vec3 f = org - shape.center;
  const auto roots = circle_roots(f, d, shape.radius);
  if (!roots) return {};
  for (const float t : {roots->x, roots->y}) {
    if (!(t > tnear && t < tfar)) continue;
    const Vec3 n = normalize(f + d * t);
    return ShapeHit{t, shape.center + n * shape.radius, n,
                    Vec2(turn_fraction(n.y, n.x), math::acos(clamp(-n.z, -1.0f, 1.0f)) * kInvPi)};
  }
  return {};
}

std::optional<ShapeHit> intersect(const Cylinder& shape, const Vec3& org, const Vec3& d,
                                  float tnear, float tfar) {
  const float half = length(shape.half_axis);
  if (!(half > 0)) return {};
  const Frame frame(shape.half_axis * (1 / half));
  const Vec3 f = frame.to_local(org - shape.center), e = frame.to_local(d);
  const auto roots = circle_roots(Vec3(f.x, f.y, 0), Vec3(e.x, e.y, 0), shape.radius);
  if (!roots) return {};
  for (const float t : {roots->x, roots->y}) {
    const Vec3 local = f + e * t;
    if (!(t > tnear && t < tfar && std::abs(local.z) <= half)) continue;
    const Vec3 n = normalize(Vec3(local.x, local.y, 0));
    const Vec3 on_side = n * shape.radius + Vec3(0, 0, local.z);
    return ShapeHit{t, shape.center + frame.to_world(on_side), frame.to_world(n),
                    Vec2(turn_fraction(n.y, n.x), (1 + local.z / half) / 2)};
  }
  return {};
}

}  // namespace oriel::geom
