// SPDX-License-Identifier: Apache-2.0
// Edge splitting without T-junctions, depending on the edge only.
#include "geom/split_edges.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

namespace oriel::geom {
namespace split_edges_test {

/// A unit square of two triangles with separate vertices: a seam along the diagonal.
Mesh square_with_seam() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.textures.resize(1);
  mesh.textures[0].coordinate = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  mesh.normals.assign(6, Vec3(0, 0, 1));
  mesh.slot = {0, 1};
  mesh.slots.resize(2);
  mesh.slots[1].name = "m";
  return mesh;
}

/// Number of occurrences of each triangle side by positions, regardless of direction.
std::map<std::array<float, 6>, int> sides_of(const Mesh& mesh) {
  std::map<std::array<float, 6>, int> sides;
  for (const Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
      Vec3 p = mesh.positions[a], q = mesh.positions[b];
      if (std::array{q.x, q.y, q.z} < std::array{p.x, p.y, p.z}) std::swap(p, q);
      ++sides[{p.x, p.y, p.z, q.x, q.y, q.z}];
    }
  return sides;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum +=
        cross(mesh.positions[t.b] - mesh.positions[t.a], mesh.positions[t.c] - mesh.positions[t.a])
            .z /
        2;
  return sum;
}

TEST(EdgeSplitter, InnerEdgesHaveTwoTrianglesForUnevenRules) {
  Mesh mesh = square_with_seam();
  EdgeSplitter splitter(mesh);
  // Finer toward a corner.
  const auto wants = [&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return length(q - p) > .02f + .2f * length((p + q) * .5f - Vec3(1, .3f, 0));
  };
  int passes = 0;
  while (splitter.pass(wants, 1 << 20)) ++passes;
  EXPECT_GT(passes, 4);
  EXPECT_GT(mesh.triangles.size(), 500u);
  EXPECT_NEAR(area_of(mesh), 1, 1e-5) << "and none is turned over";
  double boundary = 0;
  for (const auto& [side, count] : sides_of(mesh)) {
    if (count == 2) continue;
    EXPECT_EQ(count, 1);
    boundary += std::hypot(side[3] - side[0], side[4] - side[1]);
    const bool on_boundary = (side[0] == side[3] && (side[0] == 0 || side[0] == 1)) ||
                             (side[1] == side[4] && (side[1] == 0 || side[1] == 1));
    EXPECT_TRUE(on_boundary);
  }
  EXPECT_NEAR(boundary, 4, 1e-5);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (const auto& [a, b] : {std::pair{mesh.triangles[i].a, mesh.triangles[i].b},
                               {mesh.triangles[i].b, mesh.triangles[i].c}})
      EXPECT_FALSE(wants(i, a, b));
}

TEST(EdgeSplitter, SplitsApplyToBothTrianglesOfAnEdge) {
  Mesh mesh = square_with_seam();
  EdgeSplitter splitter(mesh);
  const auto first_triangle_asks_for_its_diagonal =
      [](std::uint32_t t, std::uint32_t a, std::uint32_t b) { return t == 0 && a == 2 && b == 0; };
  EXPECT_TRUE(splitter.pass(first_triangle_asks_for_its_diagonal, 100));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.slot, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  // Each side of the seam has its own middle vertex with its own coordinates.
  EXPECT_EQ(mesh.vertex_count(), 8u);
  EXPECT_EQ(mesh.positions[6], Vec3(.5f, .5f, 0));
  EXPECT_EQ(mesh.positions[7], Vec3(.5f, .5f, 0));
  EXPECT_EQ(mesh.textures[0].coordinate[6], Vec3(.5f, .5f, 0));
  EXPECT_EQ(mesh.textures[0].coordinate[7], Vec3(2, .5f, 0));
}

TEST(EdgeSplitter, TriangleLimitLeavesAConsistentMesh) {
  Mesh mesh = square_with_seam();
  EdgeSplitter splitter(mesh);
  const auto all = [](std::uint32_t, std::uint32_t, std::uint32_t) { return true; };
  EXPECT_TRUE(splitter.pass(all, 8));
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_FALSE(splitter.pass(all, 31));
  EXPECT_TRUE(splitter.exceeded);
  EXPECT_EQ(mesh.triangles.size(), 8u);
}

TEST(EdgeSplitter, FacetNormalsSplitVertices) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  add_facet_normals(mesh);
  EXPECT_EQ(mesh.vertex_count(), 6u);
  EXPECT_EQ(mesh.positions.size(), 7u);
  EXPECT_EQ(mesh.normals[1], Vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[4], Vec3(0, 1, 0));
  EXPECT_EQ(mesh.positions[4], Vec3(0, 0, 1));
}

}  // namespace split_edges_test
}  // namespace oriel::geom
