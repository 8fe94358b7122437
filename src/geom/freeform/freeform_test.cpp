// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/freeform.h"

#include "geom/freeform/test_model.h"

namespace oriel::geom::testing {
namespace freeform_test {

// A rational Bezier patch of degree 2 x 2 for an octant of the unit sphere; its last row is a
// single point, the pole. G. Farin, "Curves and Surfaces for CAGD", 5th ed., section 18.4.
void add_octant(Model& model) {
  const float s = std::sqrt(.5f);
  model.surface(
      {true, "bez2", {0, 1}}, {true, "bez2", {0, 1}},
      {model.point({1, 0, 0}), model.point({1, 1, 0}, s), model.point({0, 1, 0}),
       model.point({1, 0, 1}, s), model.point({1, 1, 1}, s * s), model.point({0, 1, 1}, s),
       model.point({0, 0, 1}), model.point({0, 0, 1}, s), model.point({0, 0, 1})});
}

TEST(FreeForm, ARationalPatchIsAnOctantOfTheSphereWithItsNormals) {
  for (const bool fine : {false, true}) {
    Model model;
    add_octant(model);
    model.approximate(fine ? criteria(.1f, 0, 0) : pieces(8, 8));
    const Mesh mesh = model.mesh();
    ASSERT_GT(mesh.triangles.size(), 100u);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      EXPECT_NEAR(length(mesh.positions[i]), 1, 1e-6f);
      EXPECT_LT(length(mesh.normals[i] - mesh.positions[i]), 1e-5f);
    }
    EXPECT_NEAR(area(mesh), kPi / 2, fine ? 3e-3 : 1e-2);
    EXPECT_TRUE(model.diagnostics.all().empty());
  }
}

TEST(FreeForm, ASphereOfSplinesIsClosed) {
  for (const bool fine : {false, true}) {
    Model model;
    model.sphere(2);
    model.approximate(fine ? criteria(0, .002f, 0) : pieces(6, 6));
    const Mesh mesh = model.mesh();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      EXPECT_NEAR(length(mesh.positions[i]), 2, 4e-6f);
      EXPECT_LT(length(mesh.normals[i] * 2.0f - mesh.positions[i]), 2e-5f);
    }
    EXPECT_EQ(open_edges(mesh), 0u);
    EXPECT_NEAR(volume(mesh), 4 * kPi / 3 * 8, fine ? .1 : .5);
  }
}

TEST(FreeForm, ATorusHasItsEquationAndIsClosed) {
  Model model;
  model.torus(3, 1);
  model.approximate(criteria(0, .01f, .5f));
  const Mesh mesh = model.mesh();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 p = mesh.positions[i];
    const float ring = std::hypot(p.x, p.y);
    EXPECT_NEAR(sqr(ring - 3) + sqr(p.z), 1, 2e-5f);
    const Vec3 out = normalize(Vec3(p.x * (1 - 3 / ring), p.y * (1 - 3 / ring), p.z));
    EXPECT_LT(length(mesh.normals[i] - out), 1e-4f);
  }
  EXPECT_EQ(open_edges(mesh), 0u);
  EXPECT_NEAR(area(mesh), 4 * kPi * kPi * 3, 1.5);
}

/// Maximum distance of many points on all triangles from the torus with radii 3 and 1.
float distance_from_torus(const Mesh& mesh) {
  float worst = 0;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const float a = float(i) / 4, b = float(j) / 4;
        const Vec3 p =
            mesh.positions[t.a] * (1 - a - b) + mesh.positions[t.b] * a + mesh.positions[t.c] * b;
        worst = std::max(worst, std::abs(std::hypot(std::hypot(p.x, p.y) - 3, p.z) - 1));
      }
  return worst;
}
float longest_edge(const Mesh& mesh) {
  float longest = 0;
  for (const Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}})
      longest = std::max(longest, length(mesh.positions[a] - mesh.positions[b]));
  return longest;
}
float largest_turn_of_normals(const Mesh& mesh) {
  float largest = 0;
  for (const Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}})
      largest = std::max(largest, std::acos(std::min(1.0f, dot(mesh.normals[a], mesh.normals[b]))));
  return largest;
}

TEST(FreeForm, CurvatureBoundsTheDistance) {
  std::size_t before = 0;
  for (const float distance : {.1f, .02f, .004f}) {
    Model model;
    model.torus(3, 1);
    model.approximate(criteria(0, distance, 0));
    const Mesh mesh = model.mesh();
    EXPECT_LT(distance_from_torus(mesh), distance);
    EXPECT_GT(distance_from_torus(mesh), distance / 20);  // and not much finer than necessary
    EXPECT_GT(mesh.triangles.size(), before);
    before = mesh.triangles.size();
  }
}

// A plane with one bump: a low triangle count is sufficient only if triangles are concentrated
// there.
TEST(FreeForm, TriangleLimitRefinesTheLargestErrorsFirst) {
  Model model;
  std::vector<scene::ControlPoint> points;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      points.push_back(model.point({float(i), float(j), i == 0 && j == 0 ? 2.0f : 0.0f}));
  model.surface({false, "bez3", {0, 1}}, {false, "bez3", {0, 1}}, std::move(points));
  scene::Approximation a = criteria(0, 1e-5f, 0);
  a.max_triangles = 400;
  model.approximate(a);
  const Mesh mesh = model.mesh();
  EXPECT_TRUE(model.diagnostics.all().empty());
  std::size_t at_the_bump = 0;
  // Vertices on the border are samples of curves; the others are corners of cells.
  for (const Triangle& t : mesh.triangles) {
    const Vec3 p = (mesh.positions[t.a] + mesh.positions[t.b] + mesh.positions[t.c]) / 3;
    at_the_bump += p.x < 1.5f && p.y < 1.5f;
  }
  EXPECT_GT(at_the_bump, mesh.triangles.size() / 2) << "of " << mesh.triangles.size();
  Model unlimited;
  unlimited.object = model.object;
  unlimited.group().settings.clear();
  unlimited.approximate(criteria(0, 1e-5f, 0));
  EXPECT_GT(unlimited.mesh().triangles.size(), 4 * mesh.triangles.size());
}

TEST(FreeForm, CurvatureBoundsTheAngleAndLengthTheLength) {
  Model angle;
  angle.torus(3, 1);
  angle.approximate(criteria(0, 0, .35f));
  // The angle between normals along an edge is at most the sum of those in both directions of its
  // cell.
  EXPECT_LT(largest_turn_of_normals(angle.mesh()), .35f * std::sqrt(2.0f));
  Model length;
  length.torus(3, 1);
  length.approximate(criteria(.5f, 0, 0));
  EXPECT_LE(longest_edge(length.mesh()), .5f);
}

TEST(FreeForm, ParametricCountsPerPatchAndDegreeRegularPerSurface) {
  Model model;
  model.torus(3, 1);
  model.approximate(pieces(2, 3));
  // 4 x 4 spans of degree 2.
  EXPECT_EQ(model.mesh().triangles.size(), 2u * (4 * 2 * 2) * (4 * 2 * 3));
  model.group().settings.clear();
  scene::Approximation regular = pieces(10, 20);
  regular.technique = scene::Approximation::Technique::Regular;
  model.approximate(regular);
  EXPECT_EQ(model.mesh().triangles.size(), 2u * 10 * 20);
}

TEST(FreeForm, TheRangeCutsTheSurface) {
  Model model;
  scene::FreeSurface& s = model.square();
  s.u_min = .25f;
  s.u_max = .5f;
  EXPECT_NEAR(area(model.mesh()), .25, 1e-6);
}

TEST(FreeForm, ATrimmedSquareIsADiscAndAHoleIsCutOut) {
  for (const bool hole : {false, true})
    for (const bool fine : {false, true}) {
      Model model;
      model.circle("c", {.5f, .5f}, .4f);
      scene::FreeSurface& s = model.square();
      s.loops.push_back({hole ? scene::SurfaceLoop::Kind::Hole : scene::SurfaceLoop::Kind::Trim,
                         {{"c", 0, 4}},
                         {}});
      model.approximate(fine ? criteria(.1f, 0, 0) : pieces(10, 10));
      scene::Approximation trim = pieces(32, 32);
      trim.kind = Kind::Trim;
      model.approximate(trim);
      const Mesh mesh = model.mesh();
      // 256 chords: sin(x) / x of the disc.
      const double x = 2 * kPi / 256, disc = kPi * .16 * std::sin(x) / x;
      EXPECT_NEAR(area(mesh), hole ? 1 - disc : disc, 2e-5);
      for (const Triangle& t : mesh.triangles) {
        const Vec3 middle =
            (mesh.positions[t.a] + mesh.positions[t.b] + mesh.positions[t.c]) / 3.0f;
        const float r = std::hypot(middle.x - .5f, middle.y - .5f);
        EXPECT_TRUE(hole ? r > .399f : r < .4f);
        EXPECT_GT(cross(mesh.positions[t.b] - mesh.positions[t.a],
                        mesh.positions[t.c] - mesh.positions[t.a])
                      .z,
                  0);
      }
      EXPECT_TRUE(model.diagnostics.all().empty());
    }
}

TEST(FreeForm, HolesLieWithinTrimsAndPartsOfCurvesMakeOneLoop) {
  Model model;
  model.circle("outer", {.5f, .5f}, .4f);
  model.circle("inner", {.5f, .5f}, .2f);
  model.line("back", {.1f, .5f}, {.9f, .5f});
  scene::FreeSurface& s = model.square();
  // The upper half of the disc without the inner one: the half circle and its diameter.
  s.loops.push_back({scene::SurfaceLoop::Kind::Trim, {{"outer", 0, 2}, {"back", 0, 1}}, {}});
  s.loops.push_back({scene::SurfaceLoop::Kind::Hole,
                     {{"inner", 0, 2}},  // closed by its chord
                     {}});
  model.approximate(pieces(20, 20));
  EXPECT_NEAR(area(model.mesh()), kPi / 2 * (.16 - .04), 1e-3);
}

TEST(FreeForm, LengthsInPixelsFallWithDistance) {
  std::size_t before = 1u << 30;
  for (const float away : {5.0f, 10.0f, 40.0f}) {
    Model model;
    model.torus(3, 1);
    scene::Approximation a = criteria(10, 0, 0);
    a.view = true;
    model.approximate(a);
    model.context.view.pixels_per_unit = 300;
    model.context.view.object_to_camera.setTranslation(Imath::V3f(0, 0, -away));
    const Mesh mesh = model.mesh();
    EXPECT_LT(mesh.triangles.size(), before);
    before = mesh.triangles.size();
    for (const Triangle& t : mesh.triangles)
      EXPECT_LE(model.context.view.pixels(mesh.positions[t.a], mesh.positions[t.b]), 10.01f);
  }
}

/// A curved patch over [0, 1] x [x0, x0 + 1]; both patches have the same rows at x = 1.
void add_bent(Model& model, float x0, bool swapped) {
  std::vector<scene::ControlPoint> points;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const float x = x0 + float(swapped ? 3 - j : i) / 3, y = float(swapped ? i : j) / 3;
      points.push_back(model.point({x, y, .7f * std::sin(5 * x) * std::cos(4 * y)}));
    }
  model.surface({false, "bez3", {0, 1}}, {false, "bez3", {0, 1}}, std::move(points));
}

/// Edges in the plane x = 1 that are not shared by two triangles.
std::size_t gaps(const Mesh& mesh) {
  std::size_t open = 0, seen = 0;
  for (const auto& [ends, use] : edges(mesh)) {
    if (std::abs(std::get<0>(ends.first) - 1) > 1e-4f ||
        std::abs(std::get<0>(ends.second) - 1) > 1e-4f)
      continue;
    ++seen;
    open += use.triangles != 2;
  }
  EXPECT_GT(seen, 3u);
  return open;
}

TEST(FreeForm, EqualBordersWithOneApproximationMeetWithoutAGap) {
  for (const bool swapped : {false, true})
    for (const scene::Approximation& a :
         {pieces(3, 3), criteria(0, .003f, 0), criteria(.1f, 0, 0)}) {
      Model model;
      add_bent(model, 0, false);
      add_bent(model, 1, swapped);
      model.approximate(a);
      EXPECT_EQ(gaps(model.mesh()), 0u);
    }
}

TEST(FreeForm, ConnectedSurfacesShareTheirEdge) {
  for (const bool connected : {true, false}) {
    Model model;
    model.line("a0", {0, 0}, {1, 0});
    model.line("a1", {1, 0}, {1, 1});
    model.line("a2", {1, 1}, {0, 1});
    model.line("a3", {0, 1}, {0, 0});
    for (const float x0 : {0.0f, 1.0f}) {
      add_bent(model, x0, false);
      model.group().freeform.surfaces.back().loops.push_back(
          {scene::SurfaceLoop::Kind::Trim,
           {{"a0", 0, 1}, {"a1", 0, 1}, {"a2", 0, 1}, {"a3", 0, 1}},
           {}});
    }
    // Coarse on one side, fine on the other.
    scene::Approximation coarse = pieces(3, 3), fine = criteria(0, .001f, 0);
    coarse.names = {"s1"};
    fine.names = {"s2"};
    model.approximate(coarse);
    model.approximate(fine);
    if (connected)
      model.group().freeform.connections.push_back(
          {{"s1", "s2"}, {{"a1", 0, 1}, {"a3", 1, 0}}, {}});
    const Mesh mesh = model.mesh();
    EXPECT_EQ(gaps(mesh) == 0, connected);
    EXPECT_TRUE(model.diagnostics.all().empty());
  }
}

TEST(FreeForm, SpecialPointsAndCurvesBecomeVerticesAndEdges) {
  Model model;
  model.line("l", {.13f, .21f}, {.77f, .64f});
  scene::FreeSurface& s = model.square();
  const std::uint32_t point = model.vertex({.3141f, .8282f, 0});
  s.loops.push_back({scene::SurfaceLoop::Kind::Special, {{"l", 0, 1}}, {point}});
  model.approximate(pieces(7, 7));
  const Mesh mesh = model.mesh();
  bool met = false;
  for (const Vec3& p : mesh.positions) met |= length(p - Vec3(.3141f, .8282f, 0)) < 1e-6f;
  EXPECT_TRUE(met);
  float along = 0;
  const Vec3 from(.13f, .21f, 0), way(.64f, .43f, 0);
  for (const auto& [ends, use] : edges(mesh)) {
    const auto on_line = [&](const Place& q) {
      const Vec3 p(std::get<0>(q), std::get<1>(q), std::get<2>(q));
      return length(cross(p - from, way)) < 1e-5f;
    };
    if (on_line(ends.first) && on_line(ends.second))
      along += std::hypot(std::get<0>(ends.first) - std::get<0>(ends.second),
                          std::get<1>(ends.first) - std::get<1>(ends.second));
  }
  EXPECT_NEAR(along, length(way), 1e-4f);
  EXPECT_NEAR(area(mesh), 1, 1e-6);
}

TEST(FreeForm, TexturesDerivativesAndMotionAreEvaluatedWithTheSurface) {
  Model model;
  scene::FreeSurface& s = model.square(Vec3(0), Vec3(2, 0, 0), Vec3(0, 3, 0));
  const auto texture = [&](bool vector, Vec3 offset) {
    s.textures.push_back({false, vector, {false, "line", {0, 1}}, {false, "line", {0, 1}}, {}});
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)})
      s.textures.back().points.push_back(model.point(vector ? offset : p * 5.0f + offset));
  };
  texture(false, {7, 0, 0});
  texture(true, {1, 0, 0});
  texture(true, {0, 1, 0});
  s.derivative = {1};
  scene::PolygonGroup& group = model.group();
  group.vectors.push_back({0, 0, 4});
  group.vertices.motion = {std::vector<std::uint32_t>(
      group.vertices.size(), static_cast<std::uint32_t>(group.vectors.size() - 1))};
  const Mesh mesh = model.mesh();
  ASSERT_EQ(mesh.textures.size(), 1u);
  ASSERT_EQ(mesh.motion.size(), 1u);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 p = mesh.positions[i];
    EXPECT_LT(length(mesh.textures[0].coordinate[i] - Vec3(7 + p.x * 5 / 2, p.y * 5 / 3, 0)),
              1e-5f);
    EXPECT_EQ(mesh.textures[0].basis_u[i], Vec3(1, 0, 0));
    EXPECT_EQ(mesh.textures[0].basis_v[i], Vec3(0, 1, 0));
    EXPECT_LT(length(mesh.dpdu[i] - Vec3(2, 0, 0)), 1e-5f);
    EXPECT_LT(length(mesh.dpdv[i] - Vec3(0, 3, 0)), 1e-5f);
    EXPECT_EQ(mesh.motion[0][i], Vec3(0, 0, 4));
  }
}

TEST(FreeForm, SurfacesHaveTheirMaterialOrLabel) {
  Model model;
  model.group().materials = {"red", "blue"};
  model.square().material = 1;
  model.square(Vec3(2, 0, 0));
  const Mesh mesh = model.mesh();
  ASSERT_EQ(mesh.slots.size(), 2u);
  EXPECT_EQ(mesh.slots[mesh.slot_of(0)].name, "blue");
  EXPECT_TRUE(
      mesh.slots[mesh.slot_of(static_cast<std::uint32_t>(mesh.triangles.size() - 1))].inherits());
  model.object.flags.push_back({"tagged", false, {}, {}});
  EXPECT_EQ(model.mesh().slots[0].label, 1u);
}

TEST(FreeForm, InvalidSurfacesAreSkippedWithOneMessage) {
  const auto broken = [](const std::function<void(Model&)>& damage) {
    Model model;
    model.line("l", {.2f, .2f}, {.4f, .4f});
    model.square();
    damage(model);
    const Mesh mesh = model.mesh();
    EXPECT_EQ(model.diagnostics.all().size(), 1u);
    return mesh.triangles.empty();
  };
  const auto surface = [](Model& m) -> scene::FreeSurface& {
    return m.group().freeform.surfaces.front();
  };
  EXPECT_TRUE(broken([&](Model& m) { surface(m).u.basis = "gone"; }));
  EXPECT_TRUE(broken([&](Model& m) {
    m.object.bases.push_back({"bad", scene::Basis::Kind::Bezier, false, 99, 1, {}});
    surface(m).u.basis = "bad";
  }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).v.parameters = {1, 0}; }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).points.pop_back(); }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).points.clear(); }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).points[2].vertex = 999; }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).points[2].weight = INFINITY; }));
  EXPECT_TRUE(broken([&](Model& m) { m.group().vectors.back().x = NAN; }));
  EXPECT_TRUE(broken([&](Model& m) { surface(m).u_min = 7; }));
  EXPECT_FALSE(broken([&](Model& m) {
    surface(m).loops.push_back({scene::SurfaceLoop::Kind::Trim, {{"gone", 0, 1}}, {}});
  }));
  EXPECT_FALSE(broken([&](Model& m) {
    m.group().freeform.connections.push_back({{"s1", "s9"}, {{"l", 0, 1}, {"l", 0, 1}}, {}});
  }));
  EXPECT_FALSE(broken([&](Model& m) { m.group().freeform.curves[0].points[0].vertex = 999; }));
}

TEST(FreeForm, CrossingTrimsAreReported) {
  Model model;
  model.curve("eight", {false, "line", {0, 1, 2, 3}},
              {model.point({.1f, .1f, 0}), model.point({.9f, .8f, 0}), model.point({.9f, .1f, 0}),
               model.point({.1f, .9f, 0})});
  model.square().loops.push_back({scene::SurfaceLoop::Kind::Trim, {{"eight", 0, 3}}, {}});
  const Mesh mesh = model.mesh();
  EXPECT_FALSE(mesh.triangles.empty());
  ASSERT_EQ(model.diagnostics.all().size(), 1u);
  EXPECT_EQ(model.diagnostics.all()[0].code, "OR-GEOM-033");
}

TEST(FreeForm, HugeSubdivisionsStayWithinMemory) {
  Model model;
  model.torus(3, 1);
  scene::Approximation a = pieces(1e30f, 1e30f);
  model.approximate(a);
  const Mesh mesh = model.mesh();
  EXPECT_LT(mesh.vertex_count(), 4'000'001u);
  ASSERT_EQ(model.diagnostics.all().size(), 1u);
  EXPECT_EQ(model.diagnostics.all()[0].code, "OR-GEOM-034");
}

}  // namespace freeform_test
}  // namespace oriel::geom::testing
