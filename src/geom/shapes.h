// SPDX-License-Identifier: Apache-2.0
// Intersection of rays with the analytic shapes of area lights.
#pragma once

#include <optional>

#include "base/vec.h"

namespace oriel::geom {

// Conventions
//   All arguments are in one space, usually world space. `d` may have any length; t is measured in
//   it. The result is the nearest hit with tnear < t < tfar on either side. Degenerate shapes (null
//   edges or radii) and rays in the plane of a shape are never hit.

struct ShapeHit {
  float t;
  Vec3 p;
  Vec3 n;  ///< unit; outward for sphere and cylinder, edge_u x edge_v for the flat shapes
  Vec2 uv;
};

/// Parallelogram center + a edge_u + b edge_v with a, b in [-1, 1]; uv is (a, b) mapped to [0, 1].
struct Rectangle {
  Vec3 center{0, 0, 0}, edge_u{0, 0, 0}, edge_v{0, 0, 0};
};

/// Ellipse center + a radius_u + b radius_v with a^2 + b^2 <= 1; uv is (radius, angle / 2 pi).
struct Disc {
  Vec3 center{0, 0, 0}, radius_u{0, 0, 0}, radius_v{0, 0, 0};
};

/// uv is (angle around z / 2 pi, angle from -z / pi).
struct Sphere {
  Vec3 center{0, 0, 0};
  float radius = 0;
};

/// The open side of a cylinder from center - half_axis to center + half_axis; uv is (angle / 2 pi,
/// height in [0, 1]).
struct Cylinder {
  Vec3 center{0, 0, 0}, half_axis{0, 0, 0};
  float radius = 0;
};

/// Checked: Shapes.*
std::optional<ShapeHit> intersect(const Rectangle& shape, const Vec3& org, const Vec3& d,
                                  float tnear, float tfar);
std::optional<ShapeHit> intersect(const Disc& shape, const Vec3& org, const Vec3& d, float tnear,
                                  float tfar);
/// Source:  E. Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
///          Gems (2019), ch. 7; stable for small distant and huge close spheres.
std::optional<ShapeHit> intersect(const Sphere& shape, const Vec3& org, const Vec3& d, float tnear,
                                  float tfar);
std::optional<ShapeHit> intersect(const Cylinder& shape, const Vec3& org, const Vec3& d,
                                  float tnear, float tfar);

}  // namespace oriel::geom
