// SPDX-License-Identifier: Apache-2.0
#include "lights/openings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "sampling/rectangle.h"

namespace oriel {
namespace {

/// Least cosine at the lit surface that the estimate of irradiance assumes, since a part of the
/// rectangle may be higher than its centre.
constexpr float kLeastOpeningCosine = 0.1f;

bool has_table(const OpeningRectangle& r) { return r.table && r.table->structured(); }

sampling::Window window_of(const OpeningRectangle& r, const Vec3& from) {
  const Vec3 to = r.corner - from;
  const float x = dot(to, r.table->x()), y = dot(to, r.table->y());
  return PortalTable::window(x, x + r.axes.length_u, y, y + r.axes.length_v, dot(to, r.table->z()));
}

/// A direction through one rectangle, and its density among the directions through it.
Openings::Sample direction_through(const OpeningRectangle& r, const Vec3& from, Vec2 u) {
  if (!has_table(r)) {
    const auto s = sampling::SphericalRectangle(from, r.corner, r.axes).sample(u);
    return {s.wi, s.pdf};
  }
  const PortalTable& table = *r.table;
  const auto s = table.sample(u, window_of(r, from));
  return {table.x() * s.local.x + table.y() * s.local.y + table.z() * s.local.z, s.pdf};
}

/// Density of a direction among those through a rectangle, which it hits at `distance`.
float density_through(const OpeningRectangle& r, const Vec3& from, const Vec3& wi, float distance) {
  if (!has_table(r)) return sampling::SphericalRectangle(from, r.corner, r.axes).pdf(wi, distance);
  const PortalTable& table = *r.table;
  return table.pdf(Vec3(dot(wi, table.x()), dot(wi, table.y()), dot(wi, table.z())),
                   window_of(r, from));
}

}  // namespace

Openings::Openings(std::vector<OpeningRectangle> rectangles) : rectangles_(std::move(rectangles)) {
  ORIEL_ASSERT(rectangles_.size() <= kMax);
  for (OpeningRectangle& r : rectangles_) {
    r.axes = {r.edge_u, r.edge_v};
    r.centre = r.corner + (r.edge_u + r.edge_v) * 0.5f;
    r.area = r.axes.length_u * r.axes.length_v;
    r.power = r.area * (r.table ? r.table->mean_luminance() : 1.0f);
  }
}

/// The solid angle times the cosine at the surface, both as if all light came from the centre, and
/// times the radiance.
float Openings::share(const OpeningRectangle& r, const LitPoint& lit) const {
  const Vec3 to = r.centre - lit.position;
  const float height = -dot(to, r.inward);
  if (!(height > 0)) return 0;
  const float d2 = to.length2() + r.area, d = std::sqrt(d2);
  float cosine = 1;
  if (lit.normal.length2() > 0) {
    const float extent =
        (std::abs(dot(lit.normal, r.edge_u)) + std::abs(dot(lit.normal, r.edge_v))) / 2;
    const float middle = dot(lit.normal, to);
    if (!(middle + extent > 0)) return 0;
    cosine = std::max(kLeastOpeningCosine, middle / d);
  }
  return r.power * height / (d2 * d) * cosine;
}

float Openings::total(const LitPoint& lit) const {
  float sum = 0;
  for (const OpeningRectangle& r : rectangles_) sum += share(r, lit);
  return sum;
}

std::optional<Openings::Sample> Openings::sample(const LitPoint& lit, float total, Vec2 u) const {
  float left = u.x * total, share_of_chosen = 0;
  const OpeningRectangle* chosen = nullptr;
  for (const OpeningRectangle& r : rectangles_) {
    const float of_this = share(r, lit);
    if (of_this <= 0) continue;
    chosen = &r;
    share_of_chosen = of_this;
    if (left < of_this) break;
    left -= of_this;
  }
  if (!chosen) return std::nullopt;
  u.x = clamp(left / share_of_chosen, 0.0f, 0x1.fffffep-1f);
  Sample s = direction_through(*chosen, lit.position, u);
  if (!(s.pdf > 0)) return std::nullopt;
  s.pdf *= share_of_chosen;
  for (const OpeningRectangle& r : rectangles_)
    if (&r != chosen) s.pdf += density(r, lit, s.wi);
  s.pdf /= total;
  if (!std::isfinite(s.pdf)) return std::nullopt;
  return s;
}

float Openings::pdf(const LitPoint& lit, float total, const Vec3& wi) const {
  if (!(total > 0)) return 0;
  float sum = 0;
  for (const OpeningRectangle& r : rectangles_) sum += density(r, lit, wi);
  return sum / total;
}

float Openings::density(const OpeningRectangle& r, const LitPoint& lit, const Vec3& wi) const {
  const Vec3 to = r.centre - lit.position;
  const float height = dot(to, r.inward), slope = dot(wi, r.inward);
  if (!(height < 0 && slope < 0)) return 0;  // light enters through the other side
  const float distance = height / slope;
  const Vec3 aside = wi * distance - to;
  if (!(2 * std::abs(dot(aside, r.axes.x)) <= r.axes.length_u &&
        2 * std::abs(dot(aside, r.axes.y)) <= r.axes.length_v))
    return 0;
  const float of_this = share(r, lit);
  return of_this > 0 ? of_this * density_through(r, lit.position, wi, distance) : 0;
}

}  // namespace oriel
