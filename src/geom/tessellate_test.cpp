// SPDX-License-Identifier: Apache-2.0
// Tessellation of objects: shared vertices are kept, invalid polygons are counted and dropped.
#include "geom/tessellate.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel::geom {
namespace tessellate_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A group whose vertex i is vector i.
scene::PolygonGroup group_of(std::vector<Vec3> places,
                             const std::vector<std::vector<std::uint32_t>>& polygons) {
  scene::PolygonGroup group;
  group.vectors = std::move(places);
  for (std::uint32_t i = 0; i < group.vectors.size(); ++i) group.vertices.point.push_back(i);
  group.polygons.first.push_back(0);
  for (const auto& corners : polygons) {
    group.polygons.indices.insert(group.polygons.indices.end(), corners.begin(), corners.end());
    group.polygons.first.push_back(static_cast<std::uint32_t>(group.polygons.indices.size()));
  }
  return group;
}

const std::vector<Vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Tessellate, KeepsOneVertexPerDifferentVertexOfTheScene) {
  scene::Object object;
  object.groups.push_back(group_of(kSquare, {{0, 1, 2, 3}}));
  object.groups.push_back(group_of(kSquare, {{0, 1, 2}}));
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  EXPECT_EQ(mesh.vertex_count(), 8u);
  EXPECT_EQ(mesh.positions.size(), 9u) << "one spare for 16-byte reads";
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], (Triangle{4, 5, 6}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.slot.empty());
  ASSERT_EQ(mesh.slots.size(), 1u);
  EXPECT_TRUE(mesh.slots[0].inherits());
  EXPECT_TRUE(diagnostics.all().empty());
  EXPECT_EQ(mesh.bounds().max, Vec3(1, 1, 0));
}

TEST(Tessellate, CutsHolesOfTheRightPolygons) {
  scene::PolygonGroup group = group_of(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},
      {{0, 1, 2}, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 2, 3}});
  group.polygons.holes = {7};
  scene::Object object;
  object.groups.push_back(group);
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  float area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t.a];
    area += cross(mesh.positions[t.b] - a, mesh.positions[t.c] - a).z / 2;
  }
  EXPECT_FLOAT_EQ(area, 8 + 15 + 8);
}

TEST(Tessellate, MissingFieldsOfMixedColumnsAreNull) {
  scene::PolygonGroup with = group_of(kSquare, {{0, 1, 2}});
  with.vectors.push_back(Vec3(0, 0, 2));
  with.vertices.normal = {4, kNone, 4, 4};
  with.vertices.textures.resize(1);
  with.vertices.textures[0].coordinate = {0, 1, 2, 3};
  scene::Object object;
  object.groups.push_back(group_of(kSquare, {{0, 1, 2}}));
  object.groups.push_back(with);
  object.groups.push_back(group_of(kSquare, {{0, 1, 2}}));
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  ASSERT_EQ(mesh.normals.size(), 12u);
  EXPECT_EQ(mesh.normals[0], Vec3(0));
  EXPECT_EQ(mesh.normals[4], Vec3(0, 0, 1)) << "unit length";
  EXPECT_EQ(mesh.normals[5], Vec3(0));
  EXPECT_EQ(mesh.normals[11], Vec3(0));
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].coordinate[6], Vec3(1, 1, 0));
  EXPECT_TRUE(mesh.textures[0].basis_u.empty());
}

// Two triangles with separate vertices per corner, as some exporters write them, become a square
// with four vertices.
TEST(Tessellate, EqualVerticesAreMerged) {
  scene::PolygonGroup group = group_of(kSquare, {{0, 1, 2}, {3, 4, 5}});
  group.vectors.push_back(Vec3(0, 0, 1));
  group.vectors.push_back(Vec3(0, 1, 0));
  group.vertices.point = {0, 1, 2, 0, 2, 3};
  group.vertices.normal = {4, 4, 4, 4, 4, 4};
  group.vertices.user = {{0, 1, 2, 3, 4, 5}};
  scene::Object object;
  object.groups.push_back(group);
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_EQ(mesh.normals.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (Triangle{0, 2, 3}));
  EXPECT_EQ(mesh.positions[3], kSquare[3]);

  // A different normal or texture coordinate at a corner keeps its vertex separate.
  object.groups[0].vertices.normal[3] = 5;
  object.groups[0].vertices.textures.resize(1);
  object.groups[0].vertices.textures[0].coordinate = {0, 0, 0, 0, kNone, 0};
  const Mesh apart = tessellate(object, diagnostics);
  ASSERT_EQ(apart.vertex_count(), 6u);
  EXPECT_EQ(apart.normals[3], Vec3(0, 1, 0));
  EXPECT_EQ(apart.triangles[1], (Triangle{3, 4, 5}));
}

// A point with more normals than are compared still has the correct one at every corner.
TEST(Tessellate, PointsWithManyNormalsKeepThemAll) {
  scene::PolygonGroup group = group_of(kSquare, {});
  for (int round = 0; round < 2; ++round)
    for (std::uint32_t i = 0; i < 40; ++i) {
      if (round == 0) group.vectors.push_back(Vec3(static_cast<float>(i), 1, 0));
      const auto first = static_cast<std::uint32_t>(3 * (40 * round + i));
      group.polygons.indices.insert(group.polygons.indices.end(), {first, first + 1, first + 2});
      group.polygons.first.push_back(first + 3);
    }
  group.vertices.point.clear();
  for (std::uint32_t corner = 0; corner < 240; ++corner) {
    group.vertices.point.push_back(corner % 3);
    group.vertices.normal.push_back(4 + corner / 3 % 40);
  }
  scene::Object object;
  object.groups.push_back(group);
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  ASSERT_EQ(mesh.triangles.size(), 80u);
  for (std::uint32_t i = 0; i < 80; ++i) {
    const Vec3 normal = normalize(Vec3(static_cast<float>(i % 40), 1, 0));
    EXPECT_EQ(mesh.normals[mesh.triangles[i].c], normal);
    EXPECT_EQ(mesh.positions[mesh.triangles[i].c], kSquare[2]);
  }
}

TEST(Tessellate, MaterialsOfGroupsWithEqualNamesShareASlot) {
  scene::PolygonGroup a = group_of(kSquare, {{0, 1, 2, 3}, {0, 1, 2}});
  a.materials = {"wood", "glass"};
  a.polygons.material = {1, 0};
  scene::PolygonGroup b = group_of(kSquare, {{0, 1, 2}, {0, 1, 2}});
  b.materials = {"glass"};
  b.polygons.material = {0, kNone};
  scene::Object object;
  object.groups = {a, b};
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  ASSERT_EQ(mesh.slots.size(), 3u);
  EXPECT_EQ(mesh.slots[mesh.slot_of(0)].name, "glass");
  EXPECT_EQ(mesh.slots[mesh.slot_of(1)].name, "glass");
  EXPECT_EQ(mesh.slots[mesh.slot_of(2)].name, "wood");
  EXPECT_EQ(mesh.slots[mesh.slot_of(3)].name, "glass");
  EXPECT_TRUE(mesh.slots[mesh.slot_of(4)].inherits());
}

TEST(Tessellate, SkipsInvalidPolygonsWithOneDiagnosticPerObject) {
  scene::PolygonGroup group = group_of(kSquare, {{0, 1, 2, 3},
                                                 {0, 1, 1},
                                                 {0, 1},
                                                 {},
                                                 {0, 1, 9},
                                                 {0, 1, 4},
                                                 {0, 1, 5, 3, 2},
                                                 {0, 1, 6},
                                                 {0, 0, 0, 0, 0}});
  for (const float bad : {kNan, std::numeric_limits<float>::infinity(), 1e30f}) {
    group.vertices.point.push_back(static_cast<std::uint32_t>(group.vectors.size()));
    group.vectors.push_back(Vec3(bad, 0, 0));
  }
  scene::Object object;
  object.name = "broken";
  object.groups = {group};
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-GEOM-001");
  EXPECT_NE(diagnostics.all()[0].message.find("8 of its polygons"), std::string::npos);
  for (const Vec3& p : mesh.positions) EXPECT_TRUE(is_finite(p));
}

TEST(Tessellate, EmptyObjectsGiveEmptyMeshes) {
  scene::Object object;
  object.groups.emplace_back();
  Diagnostics diagnostics;
  const Mesh mesh = tessellate(object, diagnostics);
  EXPECT_TRUE(mesh.empty());
  EXPECT_EQ(mesh.vertex_count(), 0u);
  EXPECT_TRUE(mesh.bounds().isEmpty());
}

}  // namespace tessellate_test
}  // namespace oriel::geom
