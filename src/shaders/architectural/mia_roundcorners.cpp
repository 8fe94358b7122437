// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_roundcorners.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/frame.h"
#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/shader_node.h"
#include "runtime/tracer.h"

namespace oriel {
namespace {

struct MiaRoundcornersParams {
  float radius;
  bool allow_different_materials;
  ShaderRef bump;
  int bump_mode;
  Vec3 bump_vector;
  int edges;
};

constexpr ParamSpec kMiaRoundcornersRows[] = {
    {ORIEL_PARAM(MiaRoundcornersParams, radius), .min = 0, .unit = "scene units",
     .doc = "Distance from an edge at which rounding starts.", .declared_default = false},
    {ORIEL_PARAM(MiaRoundcornersParams, allow_different_materials),
     .doc = "Whether edges to other materials are rounded too.", .declared_default = false},
    {ORIEL_PARAM(MiaRoundcornersParams, bump), .doc = "Bump shader evaluated first (bump_mode 0).",
     .declared_default = false},
    {ORIEL_PARAM(MiaRoundcornersParams, bump_mode), .min = 0, .max = 8,
     .doc = "0 changes the normal and returns 0 0 0; 1-4 add, 5-8 set: in internal, world, "
            "object, camera space, for bump_vector and for the result.",
     .declared_default = false},
    {ORIEL_PARAM(MiaRoundcornersParams, bump_vector),
     .doc = "Normal or normal offset applied first (bump_mode 1-8).", .declared_default = false},
    {ORIEL_PARAM(MiaRoundcornersParams, edges), .min = 0, .max = 2,
     .doc = "Oriel extension: rounded edges; 0 all, 1 convex, 2 concave.",
     .declared_default = false},
};

/// Distance of rays below and above the surface, in radii; smaller steps do not count as edges.
constexpr float kDepth = 0.002f;
/// 1 - cosine of 2.6 degrees; faces with a smaller angle count as coplanar.
constexpr float kFlat = 1e-3f;
/// 1 + cosine of 170 degrees; faces with a larger angle have no edge to round.
constexpr float kFolded = 0.015f;
/// Cosine of 30 degrees; edges with a smaller angle between their directions count as one edge.
constexpr float kSameEdge = 0.866f;
/// Tolerance of cosines for interpolated normals of flat faces.
constexpr float kRounding = 1e-5f;

/// Fraction of the distance to an edge at which the surface is tested again, since small facets may
/// end before the edge.
constexpr float kBefore = 0.9f;

/// An edge near the point.
struct Edge {
  Vec3 move;           ///< displacement of the normal
  Vec3 across{0};      ///< unit direction of move
  float strength = 0;  ///< length of move
};

/// Searches for edges around one point.
class EdgeSearch {
 public:
  EdgeSearch(const ShadingPoint& point, float radius, bool any_material, Edges edges)
      : point_(point),
        radius_(radius),
        depth_(std::max(kDepth * radius, 4 * point.ray_offset)),
        any_material_(any_material),
        wanted_(edges),
        // Along the object axes, where most edges are.
        frame_(Frame::along(point.geometric_normal, object_axis(point))) {}

  Vec3 move() {
    // Probes below the surface find convex edges, probes above find concave ones.
    for (const float side : {-1.0f, 1.0f}) {
      if (wanted_ == (side < 0 ? Edges::TurningIn : Edges::StandingOut)) continue;
      bool any = false;
      for (int i = 0; i < 4; ++i) any |= look(side, i * 2);
      // Diagonal directions only if there was a hit.
      for (int i = 0; any && i < 4; ++i) look(side, i * 2 + 1);
    }
    Vec3 sum(0);
    for (int i = 0; i < count_; ++i) sum += edges_[static_cast<std::size_t>(i)].move;
    return sum;
  }

 private:
  static Vec3 object_axis(const ShadingPoint& point) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
      const Vec3 d = normalize(point.to_world ? transform_vector(axis, *point.to_world) : axis);
      if (std::abs(dot(d, point.geometric_normal)) < 0.7f) return d;
    }
    return Vec3(0, 0, 1);
  }

  /// Probes one of eight directions; returns whether there was a hit.
  bool look(float side, int eighth) {
    constexpr float kDiagonal = 0.70710678f;
    constexpr float kCos[] = {1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal, 0, kDiagonal};
    const Vec3 way = frame_.s * kCos[eighth] + frame_.t * kCos[(eighth + 6) % 8];
    // Extended reach, to hit edges between two probe directions.
    const float reach = radius_ * (eighth % 2 == 0 ? 1.4143f : 1.0824f);
    const auto met = point_.tracer->probe(
        point_.position + point_.geometric_normal * (side * depth_), way, reach);
    if (met) take(side, *met);
    return met.has_value();
  }

  void take(float side, const Tracer::Met& met) {
    if (!any_material_ && met.material != point_.material) return;
    // From below, a face of another object joins this one only if it is hit from inside.
    if (met.instance != point_.instance && (met.back_side == point_.back_side) != (side > 0))
      return;
    const Vec3 m = met.normal * side;
    const float cosine = dot(m, point_.normal);
    if (cosine > 1 - kFlat || cosine < kFolded - 1) return;
    const Vec3 part = m - point_.normal * cosine;
    const float sine = length(part);
    const float distance = std::max(0.0f, side * dot(point_.position - met.position, m) / sine);
    if (distance >= radius_) return;
    Edge edge;
    edge.across = part / sine;
    edge.strength = (1 - distance / radius_) * sine / (1 + cosine);
    edge.strength *= crease(side, edge.across, distance, cosine, met);
    edge.move = edge.across * edge.strength;
    if (edge.strength > 0) keep(edge);
  }

  /// Share of a crease in the angle between point and face: 0 if the surface bends smoothly.
  float crease(float side, const Vec3& across, float distance, float cosine,
               const Tracer::Met& met) const {
    const bool flat = dot(point_.normal, point_.geometric_normal) > 1 - kRounding &&
                      dot(met.normal, met.geometric_normal) > 1 - kRounding;
    if (flat || distance < 4 * depth_) return 1;
    // Just before the edge, the surface must still have the orientation of the point.
    const float before = kBefore * distance;
    const Vec3 above =
        point_.position - across * (side * before) + point_.geometric_normal * depth_;
    const auto there = point_.tracer->probe(above, -point_.geometric_normal, 3 * depth_);
    if (!there) return 0;
    const float turned = math::acos(clamp(dot(there->normal, point_.normal), -1, 1)) /
                         math::acos(clamp(cosine, -1, 1));
    return 1 - smoothstep(0.1f, 0.3f, turned);
  }

  void keep(const Edge& edge) {
    for (int i = 0; i < count_; ++i) {
      Edge& other = edges_[static_cast<std::size_t>(i)];
      if (dot(other.across, edge.across) < kSameEdge) continue;
      if (edge.strength > other.strength) other = edge;
      return;
    }
    if (count_ < static_cast<int>(edges_.size())) edges_[static_cast<std::size_t>(count_++)] = edge;
  }

  const ShadingPoint& point_;
  float radius_, depth_;
  bool any_material_;
  Edges wanted_;
  Frame frame_;
  std::array<Edge, 16> edges_;
  int count_ = 0;
};

void round_corners(const Call& call, void* result) {
  const auto& p = call.as<MiaRoundcornersParams>();
  ShadingPoint& point = call.point;
  auto& out = *static_cast<Vec3*>(result);
  out = Vec3(0);
  const Vec3 before = point.normal;
  const Edges edges = p.edges == 1   ? Edges::StandingOut
                      : p.edges == 2 ? Edges::TurningIn
                                     : Edges::All;
  const Vec3 move = rounding_of(point, p.radius, p.allow_different_materials, edges);
  const auto rounded = [&](const Vec3& n) { return move == Vec3(0) ? n : normalize(n + move); };
  if (p.bump_mode < 1 || p.bump_mode > 8) {
    if (p.bump.node && p.bump.node->spec().value) p.bump.node->vector(point);
    point.normal = rounded(point.normal);
    return;
  }
  const Vec3 after = rounded(bump_normal(point, before, p.bump_vector, p.bump_mode));
  out = bump_vector(point, before, after, p.bump_mode);
}

}  // namespace

Vec3 rounding_of(const ShadingPoint& point, float radius, bool any_material, Edges edges) {
  if (!point.tracer || !(radius > 0) || point.environment) return Vec3(0);
  return EdgeSearch(point, radius, any_material, edges).move();
}

const ShaderSpec kMiaRoundCorners = {
    .name = "mia_roundcorners",
    .library = "architectural",
    .version = 3,
    .apply = kApplyTexture,
    .doc = "Rounded shading of sharp edges.",
    .params = kMiaRoundcornersRows,
    .params_size = sizeof(MiaRoundcornersParams),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value = round_corners,
};

}  // namespace oriel
