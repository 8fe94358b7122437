// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_voronoi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/math.h"
#include "sampling/lattice_hash.h"

namespace oriel {
namespace {

struct VoronoiNode {
  Vec3 coord;
  float scale, randomness, smoothness, exponent;
  int feature, metric, dimensions, output;
};

enum VoronoiFeature {
  kVoronoiNearest,
  kVoronoiSecond,
  kVoronoiSmooth,
  kVoronoiEdge,
  kVoronoiRadius
};
enum VoronoiOutput { kVoronoiDistance, kVoronoiColor, kVoronoiPosition };

/// What a feature has at a place.
struct VoronoiValue {
  float distance = 0;
  Vec3 color = Vec3(0);
  Vec3 point = Vec3(0);
};

/// Distances, points and colours of the cells around a place.
class VoronoiCells {
 public:
  explicit VoronoiCells(const VoronoiNode& n)
      : n_(n),
        flat_(n.dimensions == 2),
        at_(flat_ ? Vec3(n.coord.x, n.coord.y, 0) * n.scale : n.coord * n.scale),
        cell_(std::floor(at_.x), std::floor(at_.y), std::floor(at_.z)) {}

  /// Place within its cell.
  Vec3 inside() const { return at_ - cell_; }
  const Vec3& cell() const { return cell_; }

  /// Point of the cell at an offset, relative to the cell of the place.
  Vec3 point(const Vec3& offset) const {
    const Vec3 key = cell_ + offset;
    Vec3 random = color(offset);
    if (flat_) {
      const float flat[] = {key.x, key.y, 1};
      random = Vec3(sampling::position_hash({flat, 2}), sampling::position_hash(flat), 0);
    }
    return offset + random * clamp01(n_.randomness);
  }

  /// Colour of the cell at an offset.
  Vec3 color(const Vec3& offset) const {
    const Vec3 key = cell_ + offset;
    Vec3 c;
    for (int i = 0; i < 3; ++i) {
      const float last = static_cast<float>(i);
      const float flat[] = {key.x, key.y, last}, solid[] = {key.x, key.y, key.z, last};
      const std::size_t less = i == 0 ? 1 : 0;  // the first number has no seed
      c[i] = flat_ ? sampling::position_hash({flat, 3 - less})
                   : sampling::position_hash({solid, 4 - less});
    }
    return c;
  }

  float distance(const Vec3& a, const Vec3& b) const {
    const Vec3 d(std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z));
    switch (n_.metric) {
      case 1:
        return d.x + d.y + d.z;
      case 2:
        return std::max({d.x, d.y, d.z});
      case 3: {
        const float e = n_.exponent;
        return math::pow(math::pow(d.x, e) + math::pow(d.y, e) + (flat_ ? 0 : math::pow(d.z, e)),
                         1 / e);
      }
      default:
        return length(d);
    }
  }

  /// Calls visit(offset) for the cells up to a number of cells away.
  template <class Visit>
  void around(int reach, Visit visit) const {
    const int deep = flat_ ? 0 : reach;
    for (int k = -deep; k <= deep; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          visit(Vec3(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)));
  }

 private:
  const VoronoiNode& n_;
  bool flat_;
  Vec3 at_, cell_;
};

constexpr float kVoronoiFarthest = std::numeric_limits<float>::max();

/// The nearest or second nearest point.
VoronoiValue nearest_point(const VoronoiCells& cells, bool second) {
  float first_distance = kVoronoiFarthest, second_distance = kVoronoiFarthest;
  Vec3 first(0), other(0);
  cells.around(1, [&](const Vec3& offset) {
    const float d = cells.distance(cells.point(offset), cells.inside());
    if (d < first_distance) {
      second_distance = first_distance, other = first;
      first_distance = d, first = offset;
    } else if (d < second_distance) {
      second_distance = d, other = offset;
    }
  });
  const Vec3 chosen = second ? other : first;
  return {second ? second_distance : first_distance, cells.color(chosen),
          cells.point(chosen) + cells.cell()};
}

VoronoiValue smooth_points(const VoronoiCells& cells, float smoothness) {
  if (!(smoothness > 0)) return nearest_point(cells, false);
  VoronoiValue v;
  v.distance = 8;
  cells.around(2, [&](const Vec3& offset) {
    const Vec3 point = cells.point(offset), color = cells.color(offset);
    const float d = cells.distance(point, cells.inside());
    const float t = clamp01(0.5f + 0.5f * (v.distance - d) / smoothness);
    const float h = t * t * (3 - 2 * t);
    float correction = smoothness * h * (1 - h);
    v.distance = lerp(v.distance, d, h) - correction;
    correction /= 1 + 3 * smoothness;
    v.color = v.color * (1 - h) + color * h - Vec3(correction);
    v.point = v.point * (1 - h) + point * h - Vec3(correction);
  });
  v.point += cells.cell();
  return v;
}

/// Distance to the edge between the cells of the nearest points.
VoronoiValue nearest_edge(const VoronoiCells& cells) {
  Vec3 closest(0);
  float least = kVoronoiFarthest;
  cells.around(1, [&](const Vec3& offset) {
    const Vec3 d = cells.point(offset) - cells.inside();
    if (dot(d, d) < least) least = dot(d, d), closest = d;
  });
  VoronoiValue v;
  v.distance = 8;
  cells.around(1, [&](const Vec3& offset) {
    const Vec3 d = cells.point(offset) - cells.inside(), across = d - closest;
    if (dot(across, across) > 1e-4f)
      v.distance = std::min(v.distance, dot((closest + d) * 0.5f, normalize(across)));
  });
  return v;
}

/// Half the distance between the nearest point and the point nearest to it.
VoronoiValue sphere_radius(const VoronoiCells& cells) {
  Vec3 closest(0), closest_offset(0);
  float least = kVoronoiFarthest;
  cells.around(1, [&](const Vec3& offset) {
    const Vec3 point = cells.point(offset);
    const float d = length(point - cells.inside());
    if (d < least) least = d, closest = point, closest_offset = offset;
  });
  VoronoiValue v;
  v.distance = kVoronoiFarthest;
  cells.around(1, [&](const Vec3& step) {
    if (step.x == 0 && step.y == 0 && step.z == 0) return;
    const Vec3 point = cells.point(closest_offset + step);
    v.distance = std::min(v.distance, length(point - closest) / 2);
  });
  return v;
}

VoronoiValue voronoi_value(const VoronoiNode& n, const VoronoiCells& cells) {
  switch (n.feature) {
    case kVoronoiSecond:
      return nearest_point(cells, true);
    case kVoronoiSmooth:
      return smooth_points(cells, std::clamp(n.smoothness / 2, 0.0f, 0.5f));
    case kVoronoiEdge:
      return nearest_edge(cells);
    case kVoronoiRadius:
      return sphere_radius(cells);
    default:
      return nearest_point(cells, false);
  }
}

void give_voronoi(const Call& call, void* result) {
  const auto& n = call.as<VoronoiNode>();
  Rgba& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!is_finite(n.coord * n.scale)) return;
  const VoronoiValue v = voronoi_value(n, VoronoiCells(n));
  Vec3 c(v.distance);
  if (n.output == kVoronoiColor) c = v.color;
  if (n.output == kVoronoiPosition) c = n.scale != 0 ? v.point / n.scale : Vec3(0);
  if (is_finite(c)) out = {c.x, c.y, c.z, 1};
}

constexpr ParamSpec kVoronoiRows[] = {
    {ORIEL_PARAM(VoronoiNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(VoronoiNode, scale), .fallback = {5}, .doc = "Factor of the coordinates."},
    {ORIEL_PARAM(VoronoiNode, randomness), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Distance of the points from a regular grid."},
    {ORIEL_PARAM(VoronoiNode, smoothness), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Width of the transitions of feature 2."},
    {ORIEL_PARAM(VoronoiNode, exponent), .fallback = {.5f}, .doc = "Exponent of metric 3."},
    {ORIEL_PARAM(VoronoiNode, feature), .min = 0, .max = 4,
     .doc = "0 nearest point, 1 second nearest, 2 smooth mean, 3 distance to the edge, 4 radius of "
            "spheres."},
    {ORIEL_PARAM(VoronoiNode, metric), .min = 0, .max = 3,
     .doc = "0 Euclidean, 1 sum, 2 maximum, 3 exponent; of features 0 to 2."},
    {ORIEL_PARAM(VoronoiNode, dimensions), .fallback = {3}, .min = 2, .max = 3,
     .doc = "2 x and y, 3 all."},
    {ORIEL_PARAM(VoronoiNode, output), .min = 0, .max = 2,
     .doc = "0 distance or radius, 1 colour of the cell, 2 position of the point."},
};

}  // namespace

const ShaderSpec kOrielVoronoi = {
    .name = "oriel_voronoi",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Distances to random points, and cells around them.",
    .params = kVoronoiRows,
    .params_size = sizeof(VoronoiNode),
    .value = give_voronoi,
};

}  // namespace oriel
