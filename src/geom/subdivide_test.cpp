// SPDX-License-Identifier: Apache-2.0
// Subdivision surfaces compared with the published limits of their schemes.
#include "geom/subdivide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "geom/append_mesh.h"

namespace oriel::geom {
namespace subdivide_test {

using scene::SubdivisionSurface;
using Form = SubdivisionSurface::Form;
using TextureRule = SubdivisionSurface::TextureRule;

/// A group whose vertex i is vector i, with one surface.
scene::PolygonGroup group_of(Form form, std::vector<Vec3> places,
                             const std::vector<std::vector<std::uint32_t>>& faces) {
  scene::PolygonGroup group;
  group.vectors = std::move(places);
  for (std::uint32_t i = 0; i < group.vectors.size(); ++i) group.vertices.point.push_back(i);
  SubdivisionSurface& surface = group.subdivisions.emplace_back();
  surface.form = form;
  surface.name = "s";
  surface.faces.first.push_back(0);
  for (const auto& corners : faces) {
    auto& list = surface.faces;
    list.indices.insert(list.indices.end(), corners.begin(), corners.end());
    list.first.push_back(static_cast<std::uint32_t>(list.indices.size()));
  }
  return group;
}

scene::PolygonGroup cube() {
  return group_of(
      Form::CcMesh,
      {{-1, -1, -1},
       {1, -1, -1},
       {1, 1, -1},
       {-1, 1, -1},
       {-1, -1, 1},
       {1, -1, 1},
       {1, 1, 1},
       {-1, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

scene::PolygonGroup octahedron() {
  return group_of(
      Form::Surface, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// A flat grid of n x n quads over [0, n].
scene::PolygonGroup grid(std::uint32_t n) {
  std::vector<Vec3> places;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x)
      places.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0f);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return group_of(Form::CcMesh, std::move(places), faces);
}

scene::Approximation levels(float n) {
  scene::Approximation a;
  a.u = a.v = n;
  return a;
}

Mesh mesh_of(const scene::PolygonGroup& group, float level) {
  Diagnostics diagnostics;
  const scene::Approximation a = levels(level);
  Mesh mesh = subdivide(group, group.subdivisions[0], false, &a, {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  return mesh;
}

float nearest(const Mesh& mesh, const Vec3& p) {
  float best = INFINITY;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    best = std::min(best, length(mesh.positions[i] - p));
  return best;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += length(cross(mesh.positions[t.b] - mesh.positions[t.a],
                        mesh.positions[t.c] - mesh.positions[t.a])) /
           2;
  return sum;
}

/// Number of occurrences of each triangle side by positions, minus those in the opposite direction.
bool is_closed(const Mesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::array<float, 3>{p.x, p.y, p.z};
  };
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> sides;
  for (const Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
      ++sides[{key(a), key(b)}];
      --sides[{key(b), key(a)}];
    }
  return std::all_of(sides.begin(), sides.end(), [](auto& s) { return s.second == 0; });
}

// A vertex of valence n goes to (n^2 v + 4 sum of edge neighbours + sum of face neighbours) /
// (n (n + 5)).
// Source: M. Halstead, M. Kass, T. DeRose, "Efficient, fair interpolation using Catmull-Clark
// surfaces", SIGGRAPH 1993.
TEST(Subdivide, CubeCornerMatchesThePublishedLimit) {
  const auto mesh = mesh_of(cube(), 2);
  // The corner (1,1,1) after one refinement by the Catmull-Clark rules:
  const Vec3 v = Vec3(5.0f / 9), f_x(1, 0, 0), f_y(0, 1, 0), f_z(0, 0, 1);
  const Vec3 e_xy = Vec3(.75f, .75f, 0), e_yz = Vec3(0, .75f, .75f), e_zx = Vec3(.75f, 0, .75f);
  const Vec3 limit = (v * 9 + (e_xy + e_yz + e_zx) * 4 + f_x + f_y + f_z) * (1.0f / 24);
  EXPECT_LT(nearest(mesh, limit), 1e-6f);
  EXPECT_TRUE(is_closed(mesh));
  // The middle of a face has valence 4 and is regular: after one refinement v, e, f as above.
  const Vec3 top(0, 0, (16 * 1.0f + 4 * 4 * .75f + 4 * 5.0f / 9) / 36);
  EXPECT_LT(nearest(mesh, top), 1e-6f);
}

// Loop: beta = (5/8 - (3/8 + cos(2 pi/n)/4)^2) / n; the limit is v (1 - n chi) + chi sum of
// neighbours with chi = 1 / (3/(8 beta) + n).
TEST(Subdivide, OctahedronVertexMatchesLoopsLimit) {
  const double c = 3.0 / 8 + std::cos(kPi / 2) / 4;
  const double beta = (5.0 / 8 - c * c) / 4, chi = 1 / (3 / (8 * beta) + 4);
  const auto mesh = mesh_of(octahedron(), 3);
  // The neighbours of a vertex sum to null.
  EXPECT_LT(nearest(mesh, Vec3(static_cast<float>(1 - 4 * chi), 0, 0)), 1e-6f);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.triangles.size(), 8u * 64);
}

TEST(Subdivide, NormalsOfALimitSurfacePointOutwardsAndAreUnit) {
  for (const auto& group : {cube(), octahedron()}) {
    const Mesh mesh = mesh_of(group, 3);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-5f);
      EXPECT_GT(dot(mesh.normals[i], normalize(mesh.positions[i])), .95f);
    }
  }
}

TEST(Subdivide, AreasConvergeFourfoldWithEachLevel) {
  double area[6] = {};
  for (int level = 1; level < 6; ++level)
    area[level] = area_of(mesh_of(cube(), static_cast<float>(level)));
  for (int level = 2; level < 5; ++level) {
    const double ratio = (area[level] - area[level - 1]) / (area[level + 1] - area[level]);
    EXPECT_NEAR(ratio, 4, .6) << level;
  }
  // The limit lies between the spheres around its nearest and its farthest points, which are the
  // middles of the faces and the corners' limits (see above).
  const auto sphere = [](double radius) { return 4 * kPi * radius * radius; };
  EXPECT_GT(area[5], sphere(.7));
  EXPECT_LT(area[5], sphere(.87));
}

TEST(Subdivide, TheBoundaryIsTheSplineOfTheBoundaryAndCornersStay) {
  scene::PolygonGroup group = grid(4);
  group.vectors[2].y = -1;  // centre of the lower boundary
  const Mesh mesh = mesh_of(group, 2);
  EXPECT_EQ(nearest(mesh, Vec3(0)), 0) << "corner";
  // A cubic B-spline's limit of a control point: (1 4 1) / 6.
  EXPECT_LT(nearest(mesh, Vec3(2, -4.0f / 6, 0)), 1e-6f);
  EXPECT_LT(nearest(mesh, Vec3(1, -1.0f / 6, 0)), 1e-6f);
}

TEST(Subdivide, CreaseKeepsEdgeStraightAndSplitsNormals) {
  // Two rows of quads, folded along y = 2.
  scene::PolygonGroup group = grid(4);
  for (Vec3& p : group.vectors) p.z = -std::abs(p.y - 2);
  const std::uint32_t row = 2 * 5;
  const Mesh smooth = mesh_of(group, 3);
  EXPECT_GT(nearest(smooth, Vec3(2, 2, 0)), .1f);
  for (std::uint32_t x = 0; x < 4; ++x) group.subdivisions[0].creases.push_back({8 + x, 0, 1});
  ASSERT_EQ(group.subdivisions[0].faces.indices[8 * 4], row);
  const Mesh sharp = mesh_of(group, 3);
  for (int i = 0; i <= 32; ++i) {
    float off = INFINITY;
    for (std::size_t v = 0; v < sharp.vertex_count(); ++v)
      if (std::abs(sharp.positions[v].y - 2) < 1e-4f)
        off = std::min(off, std::abs(sharp.positions[v].z));
    EXPECT_LT(off, 1e-6f);
  }
  // On the fold each position has one vertex per side, with the normal of that side.
  int sides[2] = {};
  for (std::size_t v = 0; v < sharp.vertex_count(); ++v) {
    if (std::abs(sharp.positions[v].y - 2) > 1e-5f) continue;
    EXPECT_NEAR(sharp.positions[v].z, 0, 1e-6f);
    ++sides[sharp.normals[v].y > 0];
    EXPECT_NEAR(std::abs(sharp.normals[v].y), std::sqrt(.5f), .05f);
  }
  EXPECT_EQ(sides[0], 33);
  EXPECT_EQ(sides[1], 33);
}

TEST(Subdivide, SharpnessBetweenNoneAndFullLiesBetweenTheirSurfaces) {
  scene::PolygonGroup group = grid(4);
  for (Vec3& p : group.vectors) p.z = -std::abs(p.y - 2);
  float last = -INFINITY;
  for (const float s : {0.0f, .1f, .3f, 1.0f}) {
    group.subdivisions[0].creases.clear();
    for (std::uint32_t x = 0; x < 4; ++x) group.subdivisions[0].creases.push_back({8 + x, 0, s});
    float top = -INFINITY;
    const Mesh mesh = mesh_of(group, 4);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) top = std::max(top, mesh.positions[v].z);
    EXPECT_GT(top, last);
    last = top;
  }
}

TEST(Subdivide, MarkedVerticesAreFixed) {
  scene::PolygonGroup group = cube();
  group.vertices.marks.push_back({6, scene::VertexMark::Kind::Corner, {}});
  const Mesh mesh = mesh_of(group, 3);
  EXPECT_EQ(nearest(mesh, Vec3(1)), 0);
  EXPECT_GT(nearest(mesh, Vec3(-1)), .3f);
}

TEST(Subdivide, TextureSpacesAreSmoothOrLinearInEachFaceAsWritten) {
  scene::PolygonGroup group = grid(2);
  // Coordinates: x and y, but that of the middle vertex moved.
  const auto first = static_cast<std::uint32_t>(group.vectors.size());
  for (std::uint32_t i = 0; i < first; ++i) group.vectors.push_back(group.vectors[i]);
  group.vectors[first + 4] = Vec3(1.5f, 1, 0);
  group.vertices.textures.resize(2);
  for (std::uint32_t i = 0; i < first; ++i)
    for (auto& space : group.vertices.textures) space.coordinate.push_back(first + i);
  group.subdivisions[0].texture_rules = {TextureRule::Face, TextureRule::Subdivision};
  const Mesh mesh = mesh_of(group, 2);
  ASSERT_EQ(mesh.textures.size(), 2u);
  std::size_t at = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (length(mesh.positions[v] - Vec3(1, 1, 0)) < 1e-6f) at = v;
  EXPECT_NEAR(mesh.textures[0].coordinate[at].x, 1.5f, 1e-6f) << "linear: as written";
  EXPECT_NEAR(mesh.textures[1].coordinate[at].x, 1 + .5f * 4 / 9, 1e-6f) << "(1 4 1) / 6 squared";
  // Linear along the edges of the base faces, as here between the middle and the boundary.
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& uv = mesh.textures[0].coordinate[v];
    if (std::abs(mesh.positions[v].x - 1) > 1e-6f || uv.y > 1) continue;
    EXPECT_NEAR(uv.x, 1 + .5f * uv.y, 1e-5f);
  }
}

TEST(Subdivide, ASeamOfTextureCoordinatesDoesNotCutTheSurface) {
  scene::PolygonGroup group = cube();
  // One vertex per corner of each face, each face with the whole texture.
  const auto square = static_cast<std::uint32_t>(group.vectors.size());
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
    group.vectors.push_back(p);
  auto& list = group.subdivisions[0].faces.indices;
  group.vertices.point.assign(list.begin(), list.end());
  group.vertices.textures.resize(1);
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    list[i] = i;
    group.vertices.textures[0].coordinate.push_back(square + i % 4);
  }
  const Mesh mesh = mesh_of(group, 3), plain = mesh_of(cube(), 3);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(area_of(mesh), area_of(plain), 1e-4);
  EXPECT_GT(mesh.vertex_count(), plain.vertex_count());
}

TEST(Subdivide, EachFaceKeepsItsMaterial) {
  scene::PolygonGroup group = cube();
  group.materials = {"a", "b"};
  group.subdivisions[0].faces.material = {0, 1, 0, 1, 0, kNone};
  const Mesh mesh = mesh_of(group, 2);
  ASSERT_EQ(mesh.slots.size(), 3u);
  std::map<std::string, int> count;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) ++count[mesh.slots[mesh.slot[i]].name];
  EXPECT_EQ(count["a"], 3 * 32);
  EXPECT_EQ(count["b"], 2 * 32);
  EXPECT_EQ(count[""], 32);
}

TEST(Subdivide, LevelZeroIsTheCage) {
  const Mesh mesh = mesh_of(cube(), 0);
  EXPECT_EQ(mesh.vertex_count(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(nearest(mesh, Vec3(1)), 0);
}

// The remaining part of a flat grid is measured by its area; the rest is unchanged.
TEST(Subdivide, TrimsCutPartsOfFacesAway) {
  scene::PolygonGroup group = grid(2);
  const Mesh whole = mesh_of(group, 3);
  group.subdivisions[0].trims = {{0, 1}, {3, 15}};
  for (const int level : {0, 1, 3}) {
    const Mesh mesh = mesh_of(group, level);
    for (const Triangle& t : mesh.triangles) {
      const Vec3 middle = (mesh.positions[t.a] + mesh.positions[t.b] + mesh.positions[t.c]) / 3;
      EXPECT_FALSE(middle.x < .5f && middle.y < .5f) << "part at the first corner of face 0";
      EXPECT_FALSE(middle.x > 1 && middle.y > 1) << "all of face 3";
    }
    EXPECT_NEAR(area_of(mesh), 4 - .25 - 1, 1e-5) << level;
    if (level < 3) continue;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      EXPECT_LT(nearest(whole, mesh.positions[i]), 1e-6f);
  }
}

TEST(Subdivide, InvalidFacesAreCountedAndSkipped) {
  scene::PolygonGroup group = cube();
  group.subdivisions[0].faces.indices[0] = 1;  // {1, 3, 2, 1}
  group.subdivisions[0].details.push_back({1, {"detail", "3", {}}});
  Diagnostics diagnostics;
  const scene::Approximation a = levels(1);
  const Mesh mesh = subdivide(group, group.subdivisions[0], false, &a, {}, diagnostics);
  EXPECT_EQ(mesh.triangles.size(), 5u * 8);
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-GEOM-020");
  EXPECT_EQ(diagnostics.all()[1].code, "OR-GEOM-022");
}

TEST(SubdivisionLevel, IsLimitedByTheFaceCount) {
  const auto group = cube();
  const SubdivisionCage cage = cage_of(group, group.subdivisions[0]);
  const scene::Approximation a = levels(12);
  EXPECT_EQ(subdivision_level(cage, &a, {}), 12);
  const int level = affordable_level(cage, 12);
  EXPECT_LE(6 * std::pow(4.0, level), kMaxFaces);
  EXPECT_GT(6 * std::pow(4.0, level + 1), kMaxFaces);
  EXPECT_EQ(affordable_level(cage, 2), 2);
  EXPECT_EQ(affordable_level(cage, 0), 0);
}

TEST(SubdivisionLevel, HalvesLengthsUntilTheyAreShortEnough) {
  const auto group = cube();  // edges of 2
  const SubdivisionCage cage = cage_of(group, group.subdivisions[0]);
  scene::Approximation a;
  a.technique = scene::Approximation::Technique::Criteria;
  a.length = .3f;
  EXPECT_EQ(subdivision_level(cage, &a, {}), 3) << "2 / 8 = .25";
  a.angle = .9f;  // right angles
  EXPECT_EQ(subdivision_level(cage, &a, {}), 3);
  a.any = true;
  EXPECT_EQ(subdivision_level(cage, &a, {}), 1);
  a.max_subdivisions = 2;
  a.any = false;
  EXPECT_EQ(subdivision_level(cage, &a, {}), 2);
  a.max_triangles = 48;
  EXPECT_EQ(subdivision_level(cage, &a, {}), 1) << "24 quads";
  EXPECT_EQ(subdivision_level(cage, nullptr, {}), kSubdivisionLevel);
}

TEST(AppendMesh, ColumnsThatOnePartLacksHoldNullVectors) {
  Mesh a, b;
  a.positions = {Vec3(0), Vec3(1), Vec3(2), Vec3(0)};
  a.triangles = {{0, 1, 2}};
  a.slots.resize(1);
  b = a;
  b.normals = {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)};
  b.slots[0].name = "m";
  append_mesh(a, b);
  EXPECT_EQ(a.vertex_count(), 6u);
  EXPECT_EQ(a.triangles[1], (Triangle{3, 4, 5}));
  ASSERT_EQ(a.normals.size(), 6u);
  EXPECT_EQ(a.normals[2], Vec3(0));
  EXPECT_EQ(a.normals[3], Vec3(0, 0, 1));
  EXPECT_EQ(a.slot, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(a.slots[1].name, "m");
}

}  // namespace subdivide_test
}  // namespace oriel::geom
