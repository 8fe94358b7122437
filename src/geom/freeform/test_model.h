// SPDX-License-Identifier: Apache-2.0
// Free-form objects for tests: spheres, tori and flat patches with known answers.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "geom/freeform/freeform.h"
#include "scene/object.h"

namespace oriel::geom::testing {

using Kind = scene::Approximation::Kind;

/// An object with one group under construction.
struct Model {
  scene::Object object;
  scene::ApproximationContext context;
  Diagnostics diagnostics;

  Model() {
    object.groups.emplace_back();
    object.bases = {{"line", scene::Basis::Kind::Bezier, false, 1, 1, {}},
                    {"bez2", scene::Basis::Kind::Bezier, true, 2, 1, {}},
                    {"bez3", scene::Basis::Kind::Bezier, false, 3, 1, {}},
                    {"spline2", scene::Basis::Kind::BSpline, true, 2, 1, {}}};
  }
  scene::PolygonGroup& group() { return object.groups.front(); }
  std::uint32_t vertex(Vec3 p) {
    const auto index = static_cast<std::uint32_t>(group().vectors.size());
    group().vectors.push_back(p);
    group().vertices.point.push_back(index);
    return static_cast<std::uint32_t>(group().vertices.size() - 1);
  }
  scene::ControlPoint point(Vec3 p, float weight = 1) { return {vertex(p), weight}; }

  scene::FreeSurface& surface(scene::BasisUse u, scene::BasisUse v,
                              std::vector<scene::ControlPoint> points) {
    scene::FreeSurface& s = group().freeform.surfaces.emplace_back();
    s.name = "s" + std::to_string(group().freeform.surfaces.size());
    s.u = std::move(u);
    s.v = std::move(v);
    s.u_min = s.v_min = -1e9f;  // the full range of the bases
    s.u_max = s.v_max = 1e9f;
    s.points = std::move(points);
    return s;
  }
  /// The square from `corner` along x and y, u = x - corner.x.
  scene::FreeSurface& square(Vec3 corner = Vec3(0), Vec3 u = Vec3(1, 0, 0),
                             Vec3 v = Vec3(0, 1, 0)) {
    return surface({false, "line", {0, 1}}, {false, "line", {0, 1}},
                   {point(corner), point(corner + u), point(corner + v), point(corner + u + v)});
  }
  void curve(std::string name, scene::BasisUse basis, std::vector<scene::ControlPoint> points) {
    scene::FreeCurve& c = group().freeform.curves.emplace_back();
    c.name = std::move(name);
    c.basis = std::move(basis);
    c.points = std::move(points);
  }
  void line(std::string name, Vec2 from, Vec2 to) {
    curve(std::move(name), {false, "line", {0, 1}},
          {point({from.x, from.y, 0}), point({to.x, to.y, 0})});
  }
  /// A full circle of four rational quadratic arcs, parameters 0...4.
  void circle(std::string name, Vec2 centre, float radius) {
    std::vector<scene::ControlPoint> points;
    for (int i = 0; i <= 8; ++i) {
      const Vec3 p = circle_point(i);
      points.push_back(point({centre.x + radius * p.x, centre.y + radius * p.y, 0}, p.z));
    }
    curve(std::move(name), {true, "spline2", kFullCircle}, std::move(points));
  }
  void approximate(scene::Approximation a) {
    // Parses the statement, so that the tests cover the file syntax.
    scene::Statement s;
    s.keyword = "approximate";
    const auto word = [&](const char* text) {
      scene::Value v;
      v.kind = scene::Value::Kind::Text;
      v.text = text;
      v.bare = true;
      s.values.push_back(v);
    };
    const auto number = [&](const char* text, double n) {
      word(text);
      scene::Value v;
      v.kind = scene::Value::Kind::Numbers;
      v.numbers = {n};
      s.values.push_back(v);
    };
    word(a.kind == Kind::Trim ? "trim" : a.kind == Kind::Curve ? "curve" : "surface");
    using Technique = scene::Approximation::Technique;
    if (a.view) word("view");
    if (a.technique == Technique::Regular) word("regular");
    if (a.technique != Technique::Criteria) {
      number("parametric", a.u);
      s.values.back().numbers = {a.u, a.v};
    }
    if (a.length > 0) number("length", a.length);
    if (a.distance > 0) number("distance", a.distance);
    if (a.angle > 0) number("angle", a.angle * (180 / kPi));
    if (a.technique == Technique::Criteria)
      s.values.back().numbers.insert(s.values.back().numbers.end(),
                                     {double(a.min_subdivisions), double(a.max_subdivisions)});
    if (a.max_triangles > 0) number("max", a.max_triangles);
    for (const std::string& name : a.names) {
      word(name.c_str());
      s.values.back().bare = false;
    }
    group().settings.push_back(std::move(s));
  }
  Mesh mesh() { return tessellate_freeform(object, group(), context, diagnostics); }

  /// x, y and weight of the 9 points of a unit circle.
  static Vec3 circle_point(int i) {
    const float w = i % 2 ? std::sqrt(.5f) : 1;
    const float x[8] = {1, 1, 0, -1, -1, -1, 0, 1}, y[8] = {0, 1, 1, 1, 0, -1, -1, -1};
    return {x[i % 8], y[i % 8], w};
  }
  inline static const std::vector<float> kFullCircle = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  inline static const std::vector<float> kHalfCircle = {0, 0, 0, 1, 1, 2, 2, 2};

  /// A circle around z turned around z: of radius `tube` about (ring, 0, 0) for a torus, a half
  /// circle about the origin for a sphere.
  /// Source: L. Piegl, W. Tiller, "The NURBS Book", section 8.5.
  scene::FreeSurface& torus(float ring, float tube) {
    return turned(ring, tube, 8, kFullCircle, 0);
  }
  scene::FreeSurface& sphere(float radius) { return turned(0, radius, 4, kHalfCircle, 6); }

 private:
  scene::FreeSurface& turned(float ring, float tube, int last, const std::vector<float>& knots,
                             int first) {
    std::vector<scene::ControlPoint> points;
    for (int j = 0; j <= last; ++j) {
      const Vec3 profile = circle_point(j + first);
      const float r = ring + tube * profile.x, z = tube * profile.y;
      for (int i = 0; i <= 8; ++i) {
        const Vec3 around = circle_point(i);
        points.push_back(point({r * around.x, r * around.y, z}, around.z * profile.z));
      }
    }
    return surface({true, "spline2", kFullCircle}, {true, "spline2", knots}, std::move(points));
  }
};

inline scene::Approximation pieces(float u, float v) {
  scene::Approximation a;
  a.kind = Kind::Surface;
  a.u = u;
  a.v = v;
  return a;
}
inline scene::Approximation criteria(float length, float distance, float angle, int most = 10) {
  scene::Approximation a;
  a.kind = Kind::Surface;
  a.technique = scene::Approximation::Technique::Criteria;
  a.length = length;
  a.distance = distance;
  a.angle = angle;
  a.max_subdivisions = most;
  return a;
}

/// Measures of a mesh.
inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += length(cross(mesh.positions[t.b] - mesh.positions[t.a],
                        mesh.positions[t.c] - mesh.positions[t.a])) /
           2;
  return sum;
}
inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(mesh.positions[t.a], cross(mesh.positions[t.b], mesh.positions[t.c])) / 6;
  return sum;
}
using Place = std::tuple<float, float, float>;
inline Place place(const Vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }
/// Number of triangles per edge by vertex positions; directed edges count +1 and -1.
struct EdgeUse {
  int triangles = 0, direction = 0;
};
inline std::map<std::pair<Place, Place>, EdgeUse> edges(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, EdgeUse> result;
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t v[3] = {t.a, t.b, t.c};
    for (int i = 0; i < 3; ++i) {
      Place a = place(mesh.positions[v[i]]), b = place(mesh.positions[v[(i + 1) % 3]]);
      const bool swapped = b < a;
      if (swapped) std::swap(a, b);
      EdgeUse& use = result[{a, b}];
      ++use.triangles;
      use.direction += swapped ? -1 : 1;
    }
  }
  return result;
}
/// Edges without exactly two triangles of opposite direction.
inline std::size_t open_edges(const Mesh& mesh) {
  std::size_t open = 0;
  for (const auto& [ends, use] : edges(mesh)) open += use.triangles != 2 || use.direction != 0;
  return open;
}

}  // namespace oriel::geom::testing
