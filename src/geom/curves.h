// SPDX-License-Identifier: Apache-2.0
// Hair as input of the ray tracer: round line segments and cubic Bezier curves.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace oriel::geom {

// Conventions
//   Object space. A line segment connects two consecutive points; a cubic has four consecutive
//   control points. Columns are empty or have one entry per point.
struct Curves {
  /// Memory layout of Embree.
  struct Point {
    Vec3 p{0, 0, 0};
    float radius = 0;
    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points;
  std::vector<std::uint32_t> lines;         ///< first point of each piece
  std::vector<std::uint32_t> beziers;       ///< first point of each piece; numbered after lines
  std::vector<Vec3> normals;                ///< from the scene; null where not given
  std::vector<std::vector<Vec3>> textures;  ///< one column per texture space
  std::vector<std::vector<Vec3>> motion;    ///< one column per motion step, as Mesh::motion
  /// The points at equal steps of ray time from 0 to 1; empty if the curves do not move.
  std::vector<std::vector<Point>> keys;

  bool empty() const { return lines.empty() && beziers.empty(); }
  std::size_t size() const { return lines.size() + beziers.size(); }
};

}  // namespace oriel::geom
