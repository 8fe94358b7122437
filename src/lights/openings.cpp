// SPDX-License-Identifier: Apache-2.0
#include "lights/openings.h"

#include <algorithm>
#include <array>
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

/// Shares of the rectangles at a point; they sum to `total`.
struct Openings::Shares {
  std::array<float, kMax> of{};
  float total = 0;
};

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

Openings::Shares Openings::shares_at(const LitPoint& lit) const {
  Shares shares;
  for (std::size_t i = 0; i < rectangles_.size(); ++i)
    shares.total += shares.of[i] = share(rectangles_[i], lit);
  return shares;
}

bool Openings::light(const LitPoint& lit) const {
  return std::any_of(rectangles_.begin(), rectangles_.end(),
                     [&](const OpeningRectangle& r) { return share(r, lit) > 0; });
}

std::optional<Openings::Sample> Openings::sample(const LitPoint& lit, Vec2 u) const {
  const Shares shares = shares_at(lit);
  if (!(shares.total > 0)) return std::nullopt;
  float left = u.x * shares.total;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < rectangles_.size(); ++i) {
    if (shares.of[i] <= 0) continue;
    chosen = i;
    if (left < shares.of[i]) break;
    left -= shares.of[i];
  }
  u.x = clamp(left / shares.of[chosen], 0.0f, 0x1.fffffep-1f);
  const SeenOpening seen(rectangles_[chosen], lit.position);
  const Vec3 wi = seen.sample(u);
  const float density = pdf(shares, lit, wi, [&](std::size_t i, float distance) {
    return i == chosen ? seen.pdf(wi, distance)
                       : SeenOpening(rectangles_[i], lit.position).pdf(wi, distance);
  });
  if (!(density > 0) || !std::isfinite(density)) return std::nullopt;
  return Sample{wi, density};
}

float Openings::pdf(const LitPoint& lit, const Vec3& wi) const {
  const Shares shares = shares_at(lit);
  if (!(shares.total > 0)) return 0;
  return pdf(shares, lit, wi, [&](std::size_t i, float distance) {
    return SeenOpening(rectangles_[i], lit.position).pdf(wi, distance);
  });
}

template <class F>
float Openings::pdf(const Shares& shares, const LitPoint& lit, const Vec3& wi, F&& through) const {
  float sum = 0;
  for (std::size_t i = 0; i < rectangles_.size(); ++i) {
    if (shares.of[i] <= 0) continue;
    const OpeningRectangle& r = rectangles_[i];
    const Vec3 half_u = r.edge_u * 0.5f, half_v = r.edge_v * 0.5f;
    const auto hit =
        geom::intersect(geom::Rectangle{r.corner + half_u + half_v, half_u, half_v}, lit.position,
                        wi, 0.0f, std::numeric_limits<float>::infinity());
    if (hit) sum += shares.of[i] * through(i, hit->t);
  }
  return sum / shares.total;
}

}  // namespace oriel
