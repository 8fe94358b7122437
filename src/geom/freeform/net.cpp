// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::geom::freeform {
namespace {

const scene::Basis* find_basis(const std::vector<scene::Basis>& bases, const std::string& name) {
  const auto found = std::find_if(bases.rbegin(), bases.rend(),
                                  [&](const scene::Basis& b) { return b.name == name; });
  return found == bases.rend() ? nullptr : &*found;
}

V3d xyz(const V4d& a) { return {a.x, a.y, a.z}; }

/// A weight of 0 is a point at infinity, which cannot be represented; it counts as weight 1.
double divisor(double w) { return w != 0 ? w : 1; }

}  // namespace

std::vector<V4d> control_net(const scene::PolygonGroup& group,
                             const std::vector<scene::ControlPoint>& points,
                             const std::vector<std::uint32_t>& column, std::string& fault) {
  std::vector<V4d> net;
  net.reserve(points.size());
  for (const scene::ControlPoint& p : points) {
    const std::uint32_t i = p.vertex < column.size() ? column[p.vertex] : scene::kNone;
    if (i >= group.vectors.size()) {
      fault = fmt::format("it refers to vertex {}, which does not exist", p.vertex);
      return {};
    }
    const V3d place(group.vectors[i]);
    constexpr double kFarthest = 1e18;  // same limit as for polygons
    if (!(place.length2() < kFarthest * kFarthest) || !std::isfinite(p.weight)) {
      fault = fmt::format("vertex {} or its weight is not finite", p.vertex);
      return {};
    }
    const double w = p.weight;
    net.emplace_back(place.x * w, place.y * w, place.z * w, w);
  }
  return net;
}

std::optional<CurveNet> CurveNet::make(const scene::FreeCurve& curve,
                                       const std::vector<scene::Basis>& bases,
                                       const scene::PolygonGroup& group, std::string& fault) {
  auto direction = Direction::make(find_basis(bases, curve.basis.basis), curve.basis, fault);
  if (!direction) return std::nullopt;
  if (curve.points.size() != direction->control_points()) {
    fault = fmt::format("it has {} control points, not {}", curve.points.size(),
                        direction->control_points());
    return std::nullopt;
  }
  std::vector<V4d> net = control_net(group, curve.points, group.vertices.point, fault);
  if (net.empty()) return std::nullopt;
  return CurveNet(std::move(*direction), std::move(net));
}

V3d CurveNet::at(double t) const {
  Blend b;
  direction_.blend(t, b);
  V4d sum(0);
  for (int i = 0; i < b.count; ++i)
    sum += points_[b.first + static_cast<std::size_t>(i)] * b.weight[0][i];
  return xyz(sum) / divisor(sum.w);
}

std::optional<SurfaceNet> SurfaceNet::make(const scene::BasisUse& u, const scene::BasisUse& v,
                                           const std::vector<scene::ControlPoint>& points,
                                           const std::vector<scene::Basis>& bases,
                                           const scene::PolygonGroup& group, std::string& fault) {
  auto du = Direction::make(find_basis(bases, u.basis), u, fault);
  if (!du) return std::nullopt;
  auto dv = Direction::make(find_basis(bases, v.basis), v, fault);
  if (!dv) return std::nullopt;
  // Compare without multiplying: the product could overflow.
  if (points.size() / du->control_points() != dv->control_points() ||
      points.size() % du->control_points() != 0) {
    fault = fmt::format("it has {} control points, not {} x {}", points.size(),
                        du->control_points(), dv->control_points());
    return std::nullopt;
  }
  std::vector<V4d> net = control_net(group, points, group.vertices.point, fault);
  if (net.empty()) return std::nullopt;
  return SurfaceNet(std::move(*du), std::move(*dv), std::move(net));
}

Jet SurfaceNet::jet(double u, double v) const {
  Blend a, b;
  u_.blend(u, a);
  v_.blend(v, b);
  // Homogeneous sums: value, u, v, uu, uv, vv.
  V4d s[6] = {V4d(0), V4d(0), V4d(0), V4d(0), V4d(0), V4d(0)};
  for (int j = 0; j < b.count; ++j) {
    const V4d* const row =
        points_.data() + (b.first + static_cast<std::size_t>(j)) * u_.control_points() + a.first;
    V4d value(0), first(0), second(0);
    for (int i = 0; i < a.count; ++i) {
      value += row[i] * a.weight[0][i];
      first += row[i] * a.weight[1][i];
      second += row[i] * a.weight[2][i];
    }
    s[0] += value * b.weight[0][j];
    s[1] += first * b.weight[0][j];
    s[2] += value * b.weight[1][j];
    s[3] += second * b.weight[0][j];
    s[4] += first * b.weight[1][j];
    s[5] += value * b.weight[2][j];
  }
  // The quotient rule; "The NURBS Book", equations 4.20.
  const double w = divisor(s[0].w);
  Jet jet;
  jet.p = xyz(s[0]) / w;
  jet.u = (xyz(s[1]) - jet.p * s[1].w) / w;
  jet.v = (xyz(s[2]) - jet.p * s[2].w) / w;
  jet.uu = (xyz(s[3]) - jet.u * (2 * s[1].w) - jet.p * s[3].w) / w;
  jet.uv = (xyz(s[4]) - jet.u * s[2].w - jet.v * s[1].w - jet.p * s[4].w) / w;
  jet.vv = (xyz(s[5]) - jet.v * (2 * s[2].w) - jet.p * s[5].w) / w;
  return jet;
}

V3d SurfaceNet::point(double u, double v) const {
  Blend a, b;
  u_.blend(u, a);
  v_.blend(v, b);
  V4d sum(0);
  for (int j = 0; j < b.count; ++j) {
    const V4d* const row =
        points_.data() + (b.first + static_cast<std::size_t>(j)) * u_.control_points() + a.first;
    V4d value(0);
    for (int i = 0; i < a.count; ++i) value += row[i] * a.weight[0][i];
    sum += value * b.weight[0][j];
  }
  return xyz(sum) / divisor(sum.w);
}

V3d SurfaceNet::normal(const Jet& jet, double u, double v) const {
  // Cross products with a smaller sine (or relative length) are rounding errors.
  constexpr double kLittle = 1e-7;
  const double to_u = u < (u_.begin() + u_.end()) / 2 ? 1 : -1;
  const double to_v = v < (v_.begin() + v_.end()) / 2 ? 1 : -1;
  const double width = u_.end() - u_.begin(), height = v_.end() - v_.begin();
  const double along_u = jet.u.length() * width, along_v = jet.v.length() * height;
  const auto unit = [](const V3d& n, double size) {
    const double length = n.length();
    return length > kLittle * size && length > 0 ? n / length : V3d(0);
  };
  const bool pole_u = along_u <= kLittle * along_v, pole_v = along_v <= kLittle * along_u;
  if (!pole_u && !pole_v) {
    const V3d n = unit(jet.u.cross(jet.v), jet.u.length() * jet.v.length());
    if (n != V3d(0)) return n;
  }
  // Near a pole in v, dS/du is approximately its derivative by v times the distance into the
  // surface.
  if (pole_u && !pole_v) {
    const V3d n = unit((jet.uv * to_v).cross(jet.v), jet.uv.length() * jet.v.length());
    if (n != V3d(0)) return n;
  }
  if (pole_v && !pole_u) {
    const V3d n = unit(jet.u.cross(jet.uv * to_u), jet.u.length() * jet.uv.length());
    if (n != V3d(0)) return n;
  }
  // Both vanish or are parallel: evaluate a small distance inside, and a larger one if that fails.
  for (const double step : {1e-4, 1e-2}) {
    const Jet inside = this->jet(u + to_u * step * width, v + to_v * step * height);
    const V3d n = unit(inside.u.cross(inside.v), inside.u.length() * inside.v.length());
    if (n != V3d(0)) return n;
  }
  return V3d(0);
}

}  // namespace oriel::geom::freeform
