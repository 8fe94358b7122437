// SPDX-License-Identifier: Apache-2.0
#include "prepare/object_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/frame.h"

namespace oriel {
namespace {

/// Tolerance of flatness and of a parallelogram's corners, relative to the size.
constexpr float kFlat = 1e-4f;

/// Sums over the triangles of all polygons (as fans), world space.
struct Surface {
  std::vector<Vec3> points;    ///< corners of all polygons
  std::vector<Vec3> distinct;  ///< the first five different points
  Vec3 moment{0};              ///< sum of area times centroid
  Vec3 normal{0};              ///< sum of area times normal
  float area = 0, size = 0;
};

Surface surface_of(const scene::Object& object, const Mat4& to_world) {
  Surface s;
  for (const scene::PolygonGroup& group : object.groups) {
    const scene::PolygonList& list = group.polygons;
    // Objects may be created by C shaders, whose indices are unchecked.
    const auto exists = [&](std::uint32_t vertex) {
      return vertex < group.vertices.point.size() &&
             group.vertices.point[vertex] < group.vectors.size();
    };
    const auto corner = [&](std::size_t i) {
      return transform_point(group.vectors[group.vertices.point[list.indices[i]]], to_world);
    };
    for (std::size_t p = 0; p < list.size(); ++p) {
      const std::size_t begin = list.first[p], end = list.first[p + 1];
      if (end < begin || end > list.indices.size()) continue;
      if (!std::all_of(list.indices.data() + begin, list.indices.data() + end, exists)) continue;
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3 point = corner(i);
        s.points.push_back(point);
        if (s.distinct.size() < 5 &&
            std::find(s.distinct.begin(), s.distinct.end(), point) == s.distinct.end())
          s.distinct.push_back(point);
        if (i < begin + 2) continue;
        const Vec3 a = corner(begin), b = corner(i - 1);
        const Vec3 twice = cross(b - a, point - a);
        s.normal += twice * 0.5f;
        s.area += length(twice) * 0.5f;
        s.moment += (a + b + point) * (length(twice) / 6);
      }
    }
  }
  for (const Vec3& p : s.points) s.size = std::max(s.size, length(p - s.points[0]));
  return s;
}

/// The corner opposite of the first if four points form a parallelogram; otherwise null.
const Vec3* opposite_corner(const std::vector<Vec3>& p, float size) {
  if (p.size() != 4) return nullptr;
  for (std::size_t i = 1; i < 4; ++i) {
    const Vec3 &b = p[i == 1 ? 2 : 1], &c = p[i == 3 ? 2 : 3];
    if (length(p[0] + p[i] - b - c) <= kFlat * size) return &p[i];
  }
  return nullptr;
}

void place_flat(const Surface& s, const Vec3& normal, Light& light) {
  const std::vector<Vec3>& p = s.distinct;
  if (const Vec3* opposite = opposite_corner(p, s.size)) {
    const std::size_t at = static_cast<std::size_t>(opposite - p.data());
    light.shape = LightShape::Rectangle;
    light.edge_u = p[at == 1 ? 2 : 1] - p[0];
    light.edge_v = p[at == 3 ? 2 : 3] - p[0];
    light.axes = {light.edge_u, light.edge_v};
    light.area = length(cross(light.edge_u, light.edge_v));
    light.position = (p[0] + *opposite) * 0.5f;
  } else {
    light.shape = LightShape::Disc;
    light.area = s.area;
    light.radius = std::sqrt(s.area / kPi);
    light.position = s.moment / s.area;
    const Frame frame(normal);
    light.edge_u = frame.s;
    light.edge_v = frame.t;
  }
  light.direction = light.has_direction && dot(normal, light.direction) < 0 ? -normal : normal;
}

}  // namespace

bool place_on_object(const scene::Object& object, const Mat4& to_world, Light& light) {
  const Surface s = surface_of(object, to_world);
  if (!(s.area > 0) || !std::isfinite(s.area)) return false;
  const Vec3 normal = normalize(s.normal);
  const bool is_flat =
      length(s.normal) > 0 && std::all_of(s.points.begin(), s.points.end(), [&](const Vec3& p) {
        return std::abs(dot(p - s.points[0], normal)) <= kFlat * s.size;
      });
  if (is_flat) return place_flat(s, normal, light), true;
  light.shape = LightShape::Sphere;
  light.position = s.moment / s.area;
  light.radius = 0;
  // The sphere contains the whole object, so that the object does not shadow its own light.
  for (const Vec3& p : s.points) light.radius = std::max(light.radius, length(p - light.position));
  light.area = kPi * sqr(light.radius);
  return true;
}

}  // namespace oriel
