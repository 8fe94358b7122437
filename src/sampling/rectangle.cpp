// SPDX-License-Identifier: Apache-2.0
#include "sampling/rectangle.h"

#include <algorithm>

#include "base/math.h"

namespace oriel::sampling {
namespace {

// In float and without tables, for speed: the functions of base/math.h are exact to half a unit of
// the last place, the sums here are not.

/// Absolute error below 2e-7. Source: Abramowitz, Stegun, 4.4.46.
float arc_sine(float x) {
  const float a = std::abs(x);
  float p = -0.0012624911f;
  for (const float c : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f,
                        -0.2145988016f, 1.5707963050f})
    p = fma(p, a, c);
  return std::copysign(kPi / 2 - std::sqrt(std::max(0.0f, 1 - a)) * p, x);
}

struct SineCosine {
  float sine, cosine;
};
/// For 0 to 2 pi, absolute error below 2e-6: the series of half the angle from pi, doubled.
SineCosine sine_cosine(float angle) {
  const float h = (angle - kPi) / 2, h2 = h * h;  // -pi/2 to pi/2
  float s = -2.5052108e-8f, c = -2.7557319e-7f;
  for (const float k : {2.7557319e-6f, -1.9841270e-4f, 8.3333333e-3f, -1.6666667e-1f, 1.0f})
    s = fma(s, h2, k);
  for (const float k : {2.4801587e-5f, -1.3888889e-3f, 4.1666667e-2f, -0.5f, 1.0f})
    c = fma(c, h2, k);
  s *= h;
  return {-2 * s * c, 2 * s * s - 1};
}

}  // namespace

RectangleAxes::RectangleAxes(const Vec3& edge_u, const Vec3& edge_v)
    : length_u(length(edge_u)), length_v(length(edge_v)) {
  x = edge_u * (1 / length_u);
  y = edge_v * (1 / length_v);
  z = cross(x, y);
  square_corners = sqr(dot(x, y)) <= 1e-6f;
}

SphericalRectangle::SphericalRectangle(const Vec3& point, const Vec3& corner,
                                       const RectangleAxes& axes)
    : point_(point), x_(axes.x), y_(axes.y), z_(axes.z) {
  const Vec3 d = corner - point;
  z0_ = dot(d, z_);
  if (z0_ > 0) {
    z0_ = -z0_;
    z_ = -z_;
  }
  x0_ = dot(d, x_);
  y0_ = dot(d, y_);
  x1_ = x0_ + axes.length_u;
  y1_ = y0_ + axes.length_v;

  const float cx = (x0_ + x1_) / 2, cy = (y0_ + y1_) / 2;
  const float d2 = fma(cx, cx, fma(cy, cy, z0_ * z0_));
  const float longest = std::max(axes.length_u, axes.length_v);
  const float projected = axes.length_u * axes.length_v * z0_;
  by_area_ = 4 * sqr(longest) < d2 && sqr(projected) < sqr(kSmallSolidAngle) * d2 * d2 * d2;
  if (!by_area_) measure();
}

void SphericalRectangle::measure() {
  // The dihedral angles depend only on the z components of the normals of the four edge planes.
  const float zz = z0_ * z0_;
  const auto slope = [zz](float v) {
    const float len2 = zz + v * v;
    return len2 > 0 ? v / std::sqrt(len2) : 0.0f;
  };
  const float n0 = -slope(y0_), n1 = slope(x1_), n2 = slope(y1_), n3 = -slope(x0_);
  const auto arc = [](float c) { return arc_sine(clamp(c, -1.0f, 1.0f)); };
  // The four angles minus 2 pi, computed with arc sines to avoid cancellation.
  const float a0 = arc(n0 * n1), a1 = arc(n1 * n2), a2 = arc(n2 * n3), a3 = arc(n3 * n0);
  solid_angle_ = std::max(0.0f, (a0 + a1) + (a2 + a3));
  b0_ = n0;
  b1_ = n2;
  k_ = kPi - a2 - a3;
  by_area_ = solid_angle_ < kSmallestSolidAngle;
}

float SphericalRectangle::solid_angle() const {
  SphericalRectangle measured = *this;
  measured.measure();
  return measured.solid_angle_;
}

SphericalRectangle::Sample SphericalRectangle::sample(const Vec2& u) const {
  Sample s;
  float x, y;
  if (by_area_) {
    x = lerp(x0_, x1_, u.x);
    y = lerp(y0_, y1_, u.y);
    s.distance = std::sqrt(fma(x, x, fma(y, y, z0_ * z0_)));
  } else {
    // Column: the x up to which the strip has the share u.x of the solid angle.
    const float au = fma(u.x, solid_angle_, k_);
    const auto [sine, cosine] = sine_cosine(au);
    // cu = sign(fu) / sqrt(fu^2 + b0^2) with fu = f / sine, and x = -cu z0 / sqrt(1 - cu^2), in one
    // root and one division.
    const float f = fma(cosine, b0_, -b1_), s2 = sine * sine;
    const float below = std::max(f * f - (1 - b0_ * b0_) * s2, 1e-12f * s2);
    x = clamp(std::copysign(z0_, f) * sine / std::sqrt(std::max(below, 1e-36f)), x0_, x1_);
    // Row: heights in the strip are uniform in the sine of the elevation h = y / distance.
    const float d2 = fma(x, x, z0_ * z0_);
    const float h0 = y0_ / std::sqrt(fma(y0_, y0_, d2));
    const float h1 = y1_ / std::sqrt(fma(y1_, y1_, d2));
    const float h = lerp(h0, h1, u.y);
    s.distance = std::sqrt(d2 / std::max(fma(-h, h, 1), 1e-12f));
    y = clamp(h * s.distance, y0_, y1_);
  }
  const Vec3 to_point = x_ * x + y_ * y + z_ * z0_;
  s.point = point_ + to_point;
  s.wi = s.distance > 0 ? to_point * (1 / s.distance) : z_;
  s.pdf = pdf(s.wi, s.distance);
  return s;
}

float SphericalRectangle::pdf(const Vec3& wi, float distance) const {
  if (!by_area_) return 1 / solid_angle_;
  const float cos_light = std::abs(dot(wi, z_));
  const float area = (x1_ - x0_) * (y1_ - y0_);
  return cos_light > 1e-7f && area > 0 ? distance * distance / (area * cos_light) : 0;
}

}  // namespace oriel::sampling
