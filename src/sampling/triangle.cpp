// SPDX-License-Identifier: Apache-2.0
#include "sampling/triangle.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "sampling/warp.h"

namespace oriel::sampling {
namespace {

/// Triangles seen more nearly edge-on are not sampled.
constexpr float kLeastCosine = 1e-5f;

/// The unit part of `v` that is perpendicular to `axis`.
Imath::V3d across(const Imath::V3d& v, const Imath::V3d& axis) {
  return (v - axis * v.dot(axis)).normalized();
}

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c)
    : a_(a - point),
      b_(b - point),
      c_(c - point),
      normal_(cross(b - a, c - a) * 0.5f),
      length_a_(length(a_)),
      length_b_(length(b_)),
      length_c_(length(c_)) {
  // The tangent of half the solid angle.
  const float volume = 2 * std::abs(dot(a_, normal_));
  const float beside = length_a_ * length_b_ * length_c_ + dot(a_, b_) * length_c_ +
                       dot(b_, c_) * length_a_ + dot(c_, a_) * length_b_;
  by_area_ = !(volume > kSmallestSolidAngle / 2 * beside);
  if (!by_area_) solid_angle_ = 2 * math::atan2(volume, beside);
}

SphericalTriangle::Sample SphericalTriangle::sample(const Vec2& u) const {
  Sample s;
  if (by_area_) {
    const Vec2 weights = sample_triangle(u);
    const Vec3 to = a_ + (b_ - a_) * weights.x + (c_ - a_) * weights.y;
    s.distance = length(to);
    if (!(s.distance > 0)) return s;
    s.wi = to * (1 / s.distance);
  } else {
    // In double: the sines of thin triangles are differences of nearly equal numbers.
    const auto direction = [](const Vec3& v) { return Imath::V3d(v).normalized(); };
    const Imath::V3d a = direction(a_), b = direction(b_), c = direction(c_);
    // The angle at a, of the arcs to b and to c.
    const Imath::V3d ab = across(b, a), ac = across(c, a);
    const double cosine = ab.dot(ac), sine = ab.cross(ac).length(), arc = a.dot(b);
    // The point of the arc from a to c up to which the triangle has the share u.x of its area.
    const double part = static_cast<double>(u.x) * static_cast<double>(solid_angle_);
    const double sin_part = math::sin(part), cos_part = math::cos(part);
    const double si = sin_part * cosine - cos_part * sine, co = cos_part * cosine + sin_part * sine;
    const double p = co - cosine, q = si + sine * arc;
    const double up = (q * co - p * si) * cosine - q, down = (q * si + p * co) * sine;
    const double along = down != 0 ? std::clamp(up / down, -1.0, 1.0) : 1.0;
    const Imath::V3d end = a * along + ac * std::sqrt(std::max(0.0, 1 - along * along));
    // Between b and that point, uniform in the cosine of the distance from b.
    const double z = 1 - static_cast<double>(u.y) * (1 - end.dot(b));
    const Imath::V3d to = b * z + across(end, b) * std::sqrt(std::max(0.0, 1 - z * z));
    s.wi = Vec3(to);
    s.distance = dot(a_, normal_) / dot(s.wi, normal_);
    if (!(s.distance > 0) || !std::isfinite(s.distance)) return s;
  }
  s.pdf = pdf(s.wi, s.distance);
  return s;
}

float SphericalTriangle::pdf(const Vec3& wi, float distance) const {
  if (!by_area_) return 1 / solid_angle_;
  const float seen = std::abs(dot(wi, normal_));
  return seen > kLeastCosine * length(normal_) ? sqr(distance) / seen : 0;
}

}  // namespace oriel::sampling
