// SPDX-License-Identifier: Apache-2.0
// Hair as the ray tracer reads it: round pieces of lines and of cubic Bezier curves.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace oriel::geom {

// Conventions
//   Object space. A piece of a line runs between two points that follow each other, a piece of a
//   cubic between the first and the last of four. Columns are empty or have one entry per point.
struct Curves {
  /// Laid out as the tracer reads it.
  struct Point {
    Vec3 p{0, 0, 0};
    float radius = 0;
    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points;
  std::vector<std::uint32_t> lines;         ///< first point of each piece
  std::vector<std::uint32_t> beziers;       ///< counted after lines
  std::vector<Vec3> normals;                ///< as the scene gives them; null where it does not
  std::vector<std::vector<Vec3>> textures;  ///< one column per texture space
  std::vector<std::vector<Vec3>> motion;    ///< one column per motion step, as Mesh::motion
  /// The points at equal steps of a ray's time from 0 to 1; empty: they stay.
  std::vector<std::vector<Point>> keys;

  bool empty() const { return lines.empty() && beziers.empty(); }
  std::size_t size() const { return lines.size() + beziers.size(); }
};

}  // namespace oriel::geom
