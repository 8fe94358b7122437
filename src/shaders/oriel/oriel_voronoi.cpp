// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_voronoi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "sampling/lattice_hash.h"

namespace oriel {
namespace {

struct VoronoiNode {
  Vec3 coord;
  float w, scale, randomness, smoothness, exponent;
  int feature, metric, dimensions, output;
};

enum VoronoiFeature {
  kVoronoiNearest,
  kVoronoiSecond,
  kVoronoiSmooth,
  kVoronoiEdge,
  kVoronoiRadius
};
enum VoronoiOutput { kVoronoiDistance, kVoronoiColor, kVoronoiPosition, kVoronoiW };

/// A place of D dimensions: w; x and y; x, y and z; or all.
template <int D>
using Place = std::array<float, D>;

template <int D, class Function>
Place<D> by_axis(Function function) {
  Place<D> result;
  for (int i = 0; i < D; ++i) result[i] = function(i);
  return result;
}

template <int D>
float place_dot(const Place<D>& a, const Place<D>& b) {
  float sum = 0;
  for (int i = 0; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

template <int D>
Place<D> place_between(const Place<D>& from, const Place<D>& to) {
  return by_axis<D>([&](int i) { return to[i] - from[i]; });
}

/// What a feature has at a place.
template <int D>
struct VoronoiValue {
  float distance = 0;
  Vec3 color = Vec3(0);
  Place<D> point{};
};

/// Distances, points and colours of the cells around a place.
template <int D>
class VoronoiCells {
 public:
  explicit VoronoiCells(const VoronoiNode& n) : n_(n) {
    const float all[] = {n.coord.x, n.coord.y, n.coord.z, n.w};
    for (int i = 0; i < D; ++i) {
      const float at = all[D == 1 ? 3 : i] * n.scale;
      cell_[i] = std::floor(at);
      inside_[i] = at - cell_[i];
    }
  }

  /// Place within its cell.
  const Place<D>& inside() const { return inside_; }
  const Place<D>& cell() const { return cell_; }

  /// Point of the cell at an offset, relative to the cell of the place.
  Place<D> point(const Place<D>& offset) const {
    const Place<D> random = random_place(key_of(offset));
    const float amount = clamp01(n_.randomness);
    return by_axis<D>([&](int i) { return offset[i] + random[i] * amount; });
  }

  /// Colour of the cell at an offset.
  Vec3 color(const Place<D>& offset) const {
    const auto c = sampling::position_color(key_of(offset));
    return Vec3(c[0], c[1], c[2]);
  }

  /// Distance of the point of a cell by the metric.
  float distance(const Place<D>& point) const {
    const Place<D> d = by_axis<D>([&](int i) { return std::abs(point[i] - inside_[i]); });
    if constexpr (D == 1) return d[0];
    float sum = 0;
    switch (n_.metric) {
      case 1:
        for (const float x : d) sum += x;
        return sum;
      case 2:
        return *std::max_element(d.begin(), d.end());
      case 3:
        for (const float x : d) sum += math::pow(x, n_.exponent);
        return math::pow(sum, 1 / n_.exponent);
      default:
        return std::sqrt(place_dot<D>(d, d));
    }
  }

  /// Calls visit(offset) for the cells up to a number of cells away, x fastest.
  template <class Visit>
  void around(int reach, Visit visit) const {
    Place<D> offset;
    along<D - 1>(offset, reach, visit);
  }

 private:
  template <int Axis, class Visit>
  static void along(Place<D>& offset, int reach, Visit& visit) {
    for (int i = -reach; i <= reach; ++i) {
      offset[Axis] = static_cast<float>(i);
      if constexpr (Axis == 0)
        visit(offset);
      else
        along<Axis - 1>(offset, reach, visit);
    }
  }

  Place<D> key_of(const Place<D>& offset) const {
    return by_axis<D>([&](int i) { return cell_[i] + offset[i]; });
  }

  /// A random vector of a cell: until three dimensions a part of its colour.
  static Place<D> random_place(const Place<D>& key) {
    if constexpr (D == 3) {
      return sampling::position_color(key);
    } else if constexpr (D == 4) {
      return by_axis<D>([&](int turn) {
        const Place<D> turned = by_axis<D>([&](int i) { return key[(i + 4 - turn) % 4]; });
        return sampling::position_hash(turned);
      });
    } else {
      Place<D> random;
      random[0] = sampling::position_hash(key);
      if constexpr (D == 2) {
        const float second[] = {key[0], key[1], 1};
        random[1] = sampling::position_hash(second);
      }
      return random;
    }
  }

  const VoronoiNode& n_;
  Place<D> inside_, cell_;
};

constexpr float kVoronoiFarthest = std::numeric_limits<float>::max();

/// The nearest or second nearest point.
template <int D>
VoronoiValue<D> nearest_point(const VoronoiCells<D>& cells, bool second) {
  float first_distance = kVoronoiFarthest, second_distance = kVoronoiFarthest;
  Place<D> first{}, other{};
  cells.around(1, [&](const Place<D>& offset) {
    const float d = cells.distance(cells.point(offset));
    if (d < first_distance) {
      second_distance = first_distance, other = first;
      first_distance = d, first = offset;
    } else if (d < second_distance) {
      second_distance = d, other = offset;
    }
  });
  const Place<D> chosen = second ? other : first, point = cells.point(chosen);
  return {second ? second_distance : first_distance, cells.color(chosen),
          by_axis<D>([&](int i) { return point[i] + cells.cell()[i]; })};
}

template <int D>
VoronoiValue<D> smooth_points(const VoronoiCells<D>& cells, float smoothness) {
  if (!(smoothness > 0)) return nearest_point(cells, false);
  VoronoiValue<D> v;
  v.distance = 8;
  cells.around(2, [&](const Place<D>& offset) {
    const Place<D> point = cells.point(offset);
    const Vec3 color = cells.color(offset);
    const float d = cells.distance(point);
    const float t = clamp01(0.5f + 0.5f * (v.distance - d) / smoothness);
    const float h = t * t * (3 - 2 * t);
    float correction = smoothness * h * (1 - h);
    v.distance = lerp(v.distance, d, h) - correction;
    correction /= 1 + 3 * smoothness;
    v.color = v.color * (1 - h) + color * h - Vec3(correction);
    v.point = by_axis<D>([&](int i) { return v.point[i] * (1 - h) + point[i] * h - correction; });
  });
  v.point = by_axis<D>([&](int i) { return v.point[i] + cells.cell()[i]; });
  return v;
}

/// Distance to the edge between the cells of the nearest points.
template <int D>
VoronoiValue<D> nearest_edge(const VoronoiCells<D>& cells) {
  VoronoiValue<D> v;
  v.distance = 8;
  if constexpr (D == 1) {  // to the middles between the point of this cell and its neighbours
    const float own = cells.point({0})[0];
    for (const float side : {-1.0f, 1.0f})
      v.distance =
          std::min(v.distance, std::abs((own + cells.point({side})[0]) / 2 - cells.inside()[0]));
    return v;
  }
  Place<D> closest{};
  float least = kVoronoiFarthest;
  cells.around(1, [&](const Place<D>& offset) {
    const Place<D> d = place_between<D>(cells.inside(), cells.point(offset));
    if (place_dot<D>(d, d) < least) least = place_dot<D>(d, d), closest = d;
  });
  cells.around(1, [&](const Place<D>& offset) {
    const Place<D> d = place_between<D>(cells.inside(), cells.point(offset));
    const Place<D> across = place_between<D>(closest, d);
    const float squared = place_dot<D>(across, across);
    if (squared <= 1e-4f) return;
    const float inverse = 1 / std::sqrt(squared);
    float along = 0;
    for (int i = 0; i < D; ++i) along += (closest[i] + d[i]) * 0.5f * (across[i] * inverse);
    v.distance = std::min(v.distance, along);
  });
  return v;
}

/// Half the distance between the nearest point and the point nearest to it.
template <int D>
VoronoiValue<D> sphere_radius(const VoronoiCells<D>& cells) {
  Place<D> closest{}, closest_offset{};
  float least = kVoronoiFarthest;
  cells.around(1, [&](const Place<D>& offset) {
    const Place<D> point = cells.point(offset), d = place_between<D>(cells.inside(), point);
    const float length = std::sqrt(place_dot<D>(d, d));
    if (length < least) least = length, closest = point, closest_offset = offset;
  });
  VoronoiValue<D> v;
  v.distance = kVoronoiFarthest;
  cells.around(1, [&](const Place<D>& step) {
    if (std::all_of(step.begin(), step.end(), [](float x) { return x == 0; })) return;
    const Place<D> point =
        cells.point(by_axis<D>([&](int i) { return closest_offset[i] + step[i]; }));
    const Place<D> d = place_between<D>(closest, point);
    v.distance = std::min(v.distance, std::sqrt(place_dot<D>(d, d)) / 2);
  });
  return v;
}

template <int D>
VoronoiValue<D> voronoi_value(const VoronoiNode& n) {
  const VoronoiCells<D> cells(n);
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

/// The output of the node in D dimensions.
template <int D>
Vec3 voronoi_output(const VoronoiNode& n) {
  const VoronoiValue<D> v = voronoi_value<D>(n);
  const float inverse = n.scale != 0 ? 1 / n.scale : 0;
  switch (n.output) {
    case kVoronoiColor:
      return v.color;
    case kVoronoiPosition: {
      Vec3 point(0);
      for (int i = 0; D > 1 && i < std::min(D, 3); ++i) point[i] = v.point[i] * inverse;
      return point;
    }
    case kVoronoiW:
      return Vec3(D == 1 || D == 4 ? v.point[D - 1] * inverse : 0);
    default:
      return Vec3(v.distance);
  }
}

void give_voronoi(const Call& call, void* result) {
  const auto& n = call.as<VoronoiNode>();
  Rgba& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!is_finite(n.coord * n.scale) || !std::isfinite(n.w * n.scale)) return;
  const Vec3 c = n.dimensions <= 1   ? voronoi_output<1>(n)
                 : n.dimensions == 2 ? voronoi_output<2>(n)
                 : n.dimensions == 3 ? voronoi_output<3>(n)
                                     : voronoi_output<4>(n);
  if (is_finite(c)) out = {c.x, c.y, c.z, 1};
}

constexpr ParamSpec kVoronoiRows[] = {
    {ORIEL_PARAM(VoronoiNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(VoronoiNode, w), .doc = "Coordinate of dimension 4, or of dimension 1 alone."},
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
    {ORIEL_PARAM(VoronoiNode, dimensions), .fallback = {3}, .min = 1, .max = 4,
     .doc = "1 w, 2 x and y, 3 x, y and z, 4 all."},
    {ORIEL_PARAM(VoronoiNode, output), .min = 0, .max = 3,
     .doc = "0 distance or radius, 1 colour of the cell, 2 position of the point, 3 its w."},
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
