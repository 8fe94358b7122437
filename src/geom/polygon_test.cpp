// SPDX-License-Identifier: Apache-2.0
// Triangulation preserves area, orientation and corners for all shapes.
#include "geom/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace oriel::geom {
namespace polygon_test {

using Imath::V3d;

struct Polygon {
  std::vector<Vec3> corners;
  std::vector<std::uint32_t> holes;

  void add_hole(std::vector<Vec3> hole) {
    holes.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.insert(corners.end(), hole.begin(), hole.end());
  }
};

V3d area_of_loop(std::span<const Vec3> loop) {
  V3d sum(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += (V3d(loop[i]) - V3d(loop[0])).cross(V3d(loop[i + 1]) - V3d(loop[0])) * 0.5;
  return sum;
}

// Shoelace formula: area of the outline minus that of the holes, as a vector along the normal.
V3d area_of(const Polygon& polygon) {
  const std::size_t outline = polygon.holes.empty() ? polygon.corners.size() : polygon.holes[0];
  V3d sum = area_of_loop(std::span(polygon.corners).first(outline));
  const V3d normal = sum;
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
    const std::size_t begin = polygon.holes[h];
    const std::size_t end =
        h + 1 < polygon.holes.size() ? polygon.holes[h + 1] : polygon.corners.size();
    const V3d hole = area_of_loop(std::span(polygon.corners).subspan(begin, end - begin));
    sum -= hole.dot(normal) > 0 ? hole : -hole;
  }
  return sum;
}

void expect_exact_cover(const Polygon& polygon, double tolerance = 1e-12) {
  PolygonTriangulator triangulator;
  std::vector<Triangle> triangles;
  ASSERT_TRUE(triangulator.triangulate(polygon.corners, polygon.holes, triangles));
  const V3d expected = area_of(polygon);
  const V3d normal = expected.normalized();
  double sum = 0;
  for (const Triangle& t : triangles) {
    ASSERT_LT(std::max({t.a, t.b, t.c}), polygon.corners.size());
    const Vec3 abc[] = {polygon.corners[t.a], polygon.corners[t.b], polygon.corners[t.c]};
    const double area = area_of_loop(abc).dot(normal);
    ASSERT_GT(area, 0) << "a triangle faces backward";
    sum += area;
  }
  // Every triangle has the orientation of the polygon, so an equal sum excludes overlaps and gaps.
  EXPECT_NEAR(sum / expected.length(), 1, tolerance);
}

Vec3 place(double x, double y) { return Vec3(static_cast<float>(x), static_cast<float>(y), 0); }

std::vector<Vec3> circle(double x, double y, double radius, int count, bool clockwise = false) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = (clockwise ? -1 : 1) * 2 * M_PI * i / count + 0.1;
    points.push_back(place(x + radius * std::cos(angle), y + radius * std::sin(angle)));
  }
  return points;
}

Polygon random_star(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> radius(0.2, 1);
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count, r = radius(random);
    polygon.corners.push_back(place(r * std::cos(angle), r * std::sin(angle)));
  }
  return polygon;
}

Polygon comb(int teeth) {
  Polygon polygon;
  polygon.corners = {place(0, -1), place(2 * teeth, -1)};
  for (int i = teeth; i-- > 0;) {
    polygon.corners.push_back(place(2 * i + 2, 0));
    polygon.corners.push_back(place(2 * i + 1.5, 10));
    polygon.corners.push_back(place(2 * i + 1, 10));
    polygon.corners.push_back(place(2 * i + 0.5, 0));
  }
  polygon.corners.push_back(place(0, 0));
  return polygon;
}

Polygon spiral(int count, double turns) {
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * M_PI * turns * i / (count - 1), r = 1 + a;
    polygon.corners.push_back(place(r * std::cos(a), r * std::sin(a)));
  }
  for (int i = count; i-- > 0;) {
    const double a = 2 * M_PI * turns * i / (count - 1), r = 0.5 + a;
    polygon.corners.push_back(place(r * std::cos(a), r * std::sin(a)));
  }
  return polygon;
}

Polygon moved_into_space(Polygon polygon, float offset) {
  Imath::M44f m;
  m.setEulerAngles(Imath::V3f(0.7f, -1.1f, 2.3f));
  for (Vec3& p : polygon.corners) p = transform_point(p, m) + Vec3(offset);
  return polygon;
}

TEST(PolygonTriangulator, StarsKeepTheirArea) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const Polygon star = random_star(random, 5 + i % 60);
    expect_exact_cover(star);
    // Rounded corners are not coplanar; the projection is still covered once.
    expect_exact_cover(moved_into_space(star, 3), 1e-5);
  }
}

TEST(PolygonTriangulator, CombsAndSpiralsKeepTheirArea) {
  expect_exact_cover(comb(1));
  expect_exact_cover(comb(40));
  for (const int count : {20, 100, 400}) expect_exact_cover(spiral(count, 3));
}

TEST(PolygonTriangulator, HolesRunEitherWay) {
  for (const bool clockwise : {false, true}) {
    Polygon polygon{circle(0, 0, 10, 40), {}};
    for (int i = 0; i < 8; ++i)
      polygon.add_hole(circle(6 * std::cos(i), 6 * std::sin(i), 0.5, 3 + i, clockwise));
    polygon.add_hole(circle(0, 0, 3, 30, !clockwise));
    expect_exact_cover(polygon);
    std::reverse(polygon.corners.begin(), polygon.corners.begin() + 40);
    expect_exact_cover(polygon);
  }
}

TEST(PolygonTriangulator, GridsOfHolesShareLinesAndStillKeepTheirArea) {
  // Window walls: corners of all holes are aligned, and bridges meet copies of bridges.
  Polygon wall{{place(0, 0), place(41, 0), place(41, 21), place(0, 21)}, {}};
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 10; ++y)
      wall.add_hole({place(2 * x + 1, 2 * y + 1), place(2 * x + 2, 2 * y + 1),
                     place(2 * x + 2, 2 * y + 2), place(2 * x + 1, 2 * y + 2)});
  expect_exact_cover(wall);
}

TEST(PolygonTriangulator, HolesThatTouchTheOutlineOrEachOtherKeepTheArea) {
  Polygon polygon{{place(0, 0), place(8, 0), place(8, 8), place(0, 8)}, {}};
  polygon.add_hole({place(0, 0), place(2, 1), place(1, 2)});  // at a corner
  polygon.add_hole({place(8, 4), place(6, 5), place(6, 3)});  // on a side
  polygon.add_hole({place(3, 3), place(4, 3), place(4, 4), place(3, 4)});
  polygon.add_hole({place(4, 4), place(5, 4), place(5, 5), place(4, 5)});  // at another hole
  expect_exact_cover(polygon);
}

TEST(PolygonTriangulator, RandomHolesInStarsKeepTheArea) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 100; ++i) {
    Polygon polygon = random_star(random, 50);
    // no vertex is closer than 4 to the centre, but sides are
    for (Vec3& p : polygon.corners) p *= 20;
    for (int k = 0; k < 4; ++k)
      polygon.add_hole(circle(1.2 * std::cos(k * M_PI / 2), 1.2 * std::sin(k * M_PI / 2),
                              0.2 + 0.5 * unit(random), 3 + i % 9, unit(random) < 0.5));
    expect_exact_cover(polygon);
  }
}

TEST(PolygonTriangulator, ConcaveQuadsAreCutAtTheReflexCorner) {
  const Vec3 dart[] = {place(0, 0), place(4, -1), place(1, 0), place(4, 1)};  // reflex corner 2
  for (int shift = 0; shift < 4; ++shift) {
    Polygon polygon;
    for (int i = 0; i < 4; ++i) polygon.corners.push_back(dart[(i + shift) % 4]);
    expect_exact_cover(polygon);
  }
}

TEST(PolygonTriangulator, BowTieQuadsCoverTheHullOfTheirCorners) {
  const Vec3 square[] = {place(0, 0), place(1, 0), place(1, 1), place(0, 1)};
  for (const auto& order : {std::array{0, 1, 3, 2}, std::array{0, 2, 1, 3}, std::array{1, 0, 2, 3},
                            std::array{2, 0, 1, 3}}) {
    std::vector<Vec3> corners;
    for (const int i : order) corners.push_back(square[i]);
    PolygonTriangulator triangulator;
    std::vector<Triangle> triangles;
    ASSERT_TRUE(triangulator.triangulate(corners, {}, triangles));
    ASSERT_EQ(triangles.size(), 2u);
    V3d sum(0);
    for (const Triangle& t : triangles) {
      const Vec3 abc[] = {corners[t.a], corners[t.b], corners[t.c]};
      sum += area_of_loop(abc);
    }
    EXPECT_DOUBLE_EQ(sum.length(), 1);
  }
}

TEST(PolygonTriangulator, CollinearAndRepeatedCornersCostNoArea) {
  Polygon polygon{
      {place(0, 0), place(1, 0), place(1, 0), place(2, 0), place(3, 0), place(3, 2), place(3, 3),
       place(3, 3), place(1.5, 3), place(0, 3), place(0, 1.5), place(0, 0)},
      {}};
  expect_exact_cover(polygon);
  PolygonTriangulator triangulator;
  std::vector<Triangle> triangles;
  triangulator.triangulate(polygon.corners, {}, triangles);
  std::set<std::uint32_t> used;
  for (const Triangle& t : triangles) used.insert({t.a, t.b, t.c});
  EXPECT_EQ(used.size(), 9u) << "collinear corners are kept, for their attributes";
}

TEST(PolygonTriangulator, PolygonsWithoutAreaGiveNothing) {
  PolygonTriangulator triangulator;
  std::vector<Triangle> triangles;
  const auto gives_nothing = [&](std::vector<Vec3> corners) {
    return !triangulator.triangulate(corners, {}, triangles) && triangles.empty();
  };
  EXPECT_TRUE(gives_nothing({}));
  EXPECT_TRUE(gives_nothing({place(0, 0), place(1, 0)}));
  EXPECT_TRUE(gives_nothing({place(0, 0), place(1, 1), place(2, 2)}));
  EXPECT_TRUE(gives_nothing({place(1, 1), place(1, 1), place(1, 1), place(1, 1)}));
  EXPECT_TRUE(gives_nothing({place(0, 0), place(1, 1), place(2, 2), place(3, 3), place(1, 1)}));
  EXPECT_TRUE(gives_nothing({place(0, 0), place(1, 0), place(2, 0), place(1, 0)}));
}

TEST(PolygonTriangulator, CrossingOutlinesTerminate) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int count : {5, 6, 17, 300, 3000}) {
    Polygon tangle;
    for (int i = 0; i < count; ++i) tangle.corners.push_back(place(unit(random), unit(random)));
    PolygonTriangulator triangulator;
    std::vector<Triangle> triangles;
    EXPECT_TRUE(triangulator.triangulate(tangle.corners, {}, triangles));
    EXPECT_LT(triangles.size(), static_cast<std::size_t>(count));
  }
  const std::vector<Vec3> eight = {place(0, 0), place(1, 1),   place(2, 0),
                                   place(2, 2), place(1, 1.2), place(0, 2)};
  expect_exact_cover({eight, {}});
}

TEST(PolygonTriangulator, BigOutlinesKeepTheirArea) {
  std::mt19937 random(4);
  expect_exact_cover(random_star(random, 20000), 1e-10);
  expect_exact_cover(spiral(20000, 20), 1e-9);
  expect_exact_cover(comb(10000), 1e-10);
  expect_exact_cover({circle(0, 0, 1, 50000), {}}, 1e-9);
}

}  // namespace polygon_test
}  // namespace oriel::geom
