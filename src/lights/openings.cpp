// SPDX-License-Identifier: Apache-2.0
#include "lights/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "geom/shapes.h"
#include "sampling/rectangle.h"

namespace oriel {
namespace {

/// Least cosine at the lit surface that the estimate of irradiance assumes, since a part of the
/// rectangle may be higher than its centre.
constexpr float kLeastOpeningCosine = 0.1f;

/// A rectangle seen from a point, as a density of directions.
class SeenOpening {
 public:
  SeenOpening(const OpeningRectangle& r, const Vec3& from) : r_(r), from_(from) {
    if (!by_table()) even_.emplace(from, r.corner, r.axes);
  }

  Vec3 sample(Vec2 u) const {
    if (even_) return even_->sample(u).wi;
    const Vec3 local = r_.table->sample(u, window()).local;
    return r_.table->x() * local.x + r_.table->y() * local.y + r_.table->z() * local.z;
  }
  /// Inputs:  wi: hits the rectangle at `distance`.
  float pdf(const Vec3& wi, float distance) const {
    if (even_) return even_->pdf(wi, distance);
    return r_.table->pdf(
        Vec3(dot(wi, r_.table->x()), dot(wi, r_.table->y()), dot(wi, r_.table->z())), window());
  }

 private:
  bool by_table() const { return r_.table && r_.table->structured(); }
  sampling::Window window() const {
    const Vec3 to = r_.corner - from_;
    const float x = dot(to, r_.table->x()), y = dot(to, r_.table->y());
    return PortalTable::window(x, x + r_.axes.length_u, y, y + r_.axes.length_v,
                               dot(to, r_.table->z()));
  }

  const OpeningRectangle& r_;
  const Vec3& from_;
  std::optional<sampling::SphericalRectangle> even_;  ///< without a table
};

}  // namespace

Openings::Openings(std::vector<OpeningRectangle> rectangles) : rectangles_(std::move(rectangles)) {
  ORIEL_ASSERT(rectangles_.size() <= kMax);
  for (OpeningRectangle& r : rectangles_) r.axes = {r.edge_u, r.edge_v};
}

/// The solid angle times the cosine at the surface, both as if all light came from the centre, and
/// times the radiance.
float Openings::share(const OpeningRectangle& r, const LitPoint& lit) const {
  const Vec3 half_u = r.edge_u * 0.5f, half_v = r.edge_v * 0.5f;
  const Vec3 to = r.corner + half_u + half_v - lit.position;
  const float height = -dot(to, r.inward);
  if (!(height > 0)) return 0;
  const float area = r.axes.length_u * r.axes.length_v;
  const float d2 = to.length2() + area, d = std::sqrt(d2);
  float cosine = 1;
  if (lit.normal.length2() > 0) {
    const float extent = std::abs(dot(lit.normal, half_u)) + std::abs(dot(lit.normal, half_v));
    const float middle = dot(lit.normal, to);
    if (!(middle + extent > 0)) return 0;
    cosine = std::max(kLeastOpeningCosine, middle / d);
  }
  return area * height / (d2 * d) * cosine * (r.table ? r.table->mean_luminance() : 1.0f);
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
  const SeenOpening seen(*chosen, lit.position);
  const Vec3 wi = seen.sample(u);
  const float density = pdf(lit, total, wi, [&](const OpeningRectangle& r, float distance) {
    return &r == chosen ? seen.pdf(wi, distance) : SeenOpening(r, lit.position).pdf(wi, distance);
  });
  if (!(density > 0) || !std::isfinite(density)) return std::nullopt;
  return Sample{wi, density};
}

float Openings::pdf(const LitPoint& lit, float total, const Vec3& wi) const {
  return pdf(lit, total, wi, [&](const OpeningRectangle& r, float distance) {
    return SeenOpening(r, lit.position).pdf(wi, distance);
  });
}

template <class F>
float Openings::pdf(const LitPoint& lit, float total, const Vec3& wi, F&& through) const {
  if (!(total > 0)) return 0;
  float sum = 0;
  for (const OpeningRectangle& r : rectangles_) {
    if (!(dot(wi, r.inward) < 0)) continue;  // light enters through the other side
    const Vec3 half_u = r.edge_u * 0.5f, half_v = r.edge_v * 0.5f;
    const auto hit =
        geom::intersect(geom::Rectangle{r.corner + half_u + half_v, half_u, half_v}, lit.position,
                        wi, 0.0f, std::numeric_limits<float>::infinity());
    if (!hit) continue;
    const float of_this = share(r, lit);
    if (of_this > 0) sum += of_this * through(r, hit->t);
  }
  return sum / total;
}

}  // namespace oriel
