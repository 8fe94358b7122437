// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/planar_delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace oriel::geom::freeform {
namespace planar_delaunay_test {

/// Twice the area of all faces without vertices of the enclosing triangle.
std::int64_t area_of_hull(PlanarDelaunay& mesh) {
  std::int64_t sum = 0;
  for (const PlanarDelaunay::Face& f : mesh.faces()) {
    if (*std::min_element(f.vertex.begin(), f.vertex.end()) < PlanarDelaunay::kCorners) continue;
    const GridPoint a = mesh.points()[f.vertex[0]], b = mesh.points()[f.vertex[1]],
                    c = mesh.points()[f.vertex[2]];
    const std::int64_t twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 0);
    sum += twice;
  }
  return sum;
}

bool has_fixed_edge(PlanarDelaunay& mesh, std::uint32_t a, std::uint32_t b) {
  for (const PlanarDelaunay::Face& f : mesh.faces())
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t p = f.vertex[(i + 1) % 3], q = f.vertex[(i + 2) % 3];
      if (f.fixed[i] && ((p == a && q == b) || (p == b && q == a))) return true;
    }
  return false;
}

TEST(PlanarDelaunay, FacesCoverTheSquareOnceAndTheirCirclesAreEmpty) {
  PlanarDelaunay mesh;
  std::mt19937 random(1);
  constexpr std::int64_t n = 1000;
  for (const GridPoint corner : {GridPoint{0, 0}, {n, 0}, {n, n}, {0, n}}) mesh.insert(corner);
  for (int i = 0; i < 2000; ++i)
    mesh.insert({static_cast<std::int64_t>(random() % (n + 1)),
                 static_cast<std::int64_t>(random() % (n + 1))});
  EXPECT_EQ(area_of_hull(mesh), 2 * n * n);
  // Delaunay property: the circumcircle of a face contains no point. Tests all points with some
  // faces.
  for (std::size_t k = 0; k < mesh.faces().size(); k += 97) {
    const auto& f = mesh.faces()[k];
    if (*std::min_element(f.vertex.begin(), f.vertex.end()) < PlanarDelaunay::kCorners) continue;
    const auto at = [&](int i) { return mesh.points()[f.vertex[i]]; };
    // Centre and radius from the perpendicular bisectors.
    const double ax = double(at(0).x), ay = double(at(0).y);
    const double bx = double(at(1).x) - ax, by = double(at(1).y) - ay;
    const double cx = double(at(2).x) - ax, cy = double(at(2).y) - ay;
    const double d = 2 * (bx * cy - by * cx);
    const double x = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d;
    const double y = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
    for (std::size_t p = PlanarDelaunay::kCorners; p < mesh.points().size(); ++p) {
      const double px = double(mesh.points()[p].x) - ax, py = double(mesh.points()[p].y) - ay;
      EXPECT_GE(std::hypot(px - x, py - y), std::hypot(x, y) * (1 - 1e-9));
    }
  }
}

TEST(PlanarDelaunay, FixedEdgesPersistUnderInsertion) {
  PlanarDelaunay mesh;
  std::mt19937 random(2);
  constexpr std::int64_t n = 1 << 20;
  std::vector<std::uint32_t> corners;
  for (const GridPoint corner : {GridPoint{0, 0}, {n, 0}, {n, n}, {0, n}})
    corners.push_back(mesh.insert(corner));
  const auto scatter = [&](int count) {
    for (int i = 0; i < count; ++i)
      mesh.insert(
          {static_cast<std::int64_t>(random() % n), static_cast<std::int64_t>(random() % n)});
  };
  scatter(500);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(mesh.fix_edge(corners[i], corners[(i + 1) % 4]));
  // Star-shaped; no two of them cross.
  const std::uint32_t a = mesh.insert({n / 2, n / 2 + 1}), b = mesh.insert({n - 3, n / 2 + 70}),
                      c = mesh.insert({7, n / 3});
  EXPECT_TRUE(mesh.fix_edge(a, b));
  EXPECT_TRUE(mesh.fix_edge(c, a));
  EXPECT_TRUE(has_fixed_edge(mesh, a, b));
  EXPECT_TRUE(has_fixed_edge(mesh, a, c));
  EXPECT_FALSE(mesh.fix_edge(mesh.insert({n - 9, 9}), mesh.insert({n - 11, n - 11})));
  scatter(500);
  EXPECT_EQ(area_of_hull(mesh), 2 * n * n);
}

TEST(PlanarDelaunay, PointsOnAFixedEdgeSplitIt) {
  PlanarDelaunay mesh;
  const std::uint32_t a = mesh.insert({0, 0}), b = mesh.insert({8, 0}), top = mesh.insert({4, 9}),
                      bottom = mesh.insert({4, 0});
  EXPECT_TRUE(mesh.fix_edge(a, b));
  EXPECT_TRUE(has_fixed_edge(mesh, a, bottom));
  const std::uint32_t quarter = mesh.insert({2, 0});
  EXPECT_TRUE(has_fixed_edge(mesh, a, quarter));
  EXPECT_TRUE(has_fixed_edge(mesh, quarter, bottom));
  EXPECT_TRUE(mesh.fix_edge(top, quarter));
  EXPECT_EQ(mesh.insert({2, 0}), quarter);
  EXPECT_EQ(area_of_hull(mesh), 72);
}

TEST(PlanarDelaunay, PointsTooCloseOrOutsideTheRegionAreRefused) {
  PlanarDelaunay mesh;
  const std::uint32_t a = mesh.insert({0, 0}), b = mesh.insert({100, 0});
  mesh.insert({0, 100});
  EXPECT_TRUE(mesh.fix_edge(a, b));
  for (PlanarDelaunay::Face& f : mesh.faces()) f.region = 1;
  EXPECT_EQ(mesh.insert_clear({50, 3}, 5, 1), PlanarDelaunay::kNothing);
  EXPECT_EQ(mesh.insert_clear({2, 2}, 5, 1), PlanarDelaunay::kNothing);
  EXPECT_EQ(mesh.insert_clear({20, 20}, 5, 0), PlanarDelaunay::kNothing);
  EXPECT_EQ(mesh.insert_clear({100, 0}, 5, 1), b);
  EXPECT_GT(mesh.insert_clear({20, 20}, 5, 1), b);
}

}  // namespace planar_delaunay_test
}  // namespace oriel::geom::freeform
