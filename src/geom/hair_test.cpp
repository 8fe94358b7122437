// SPDX-License-Identifier: Apache-2.0
// Hair coverage by radius, and shading at hits.
#include "geom/hair.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geom/accel.h"
#include "geom/motion.h"

namespace oriel::geom {
namespace hair_test {

using Kind = scene::Hair::Field::Kind;

scene::Hair hair_of(int degree, std::vector<float> scalars, std::vector<std::uint32_t> first) {
  scene::Hair hair;
  hair.degree = degree;
  hair.radius = .1f;
  hair.scalars = std::move(scalars);
  hair.first = std::move(first);
  return hair;
}

struct Placed {
  Accel accel;
  explicit Placed(const scene::Hair& hair, const Mat4& to_world = Mat4()) {
    Diagnostics diagnostics;
    Mesh mesh;
    add_hair(mesh, hair, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty());
    accel.add_instance({.mesh = accel.add_mesh(std::move(mesh)),
                        .local_to_world = to_world,
                        .world_to_local = to_world.inverse()});
    accel.commit();
  }
  bool hit(const Vec3& from, const Vec3& direction, SurfacePoint& point) const {
    Ray ray;
    ray.org = from;
    ray.dir = direction;
    Hit hit;
    if (!accel.intersect(ray, hit)) return false;
    accel.interpolate(hit, point);
    return true;
  }
  /// Area of the square [-1, 1]^2 in the plane z = 3 below which hair occludes a ray along -z:
  /// coverage and shadow.
  float covered() const {
    // The additive sequence of the plastic number, which fills the square evenly.
    constexpr int kPoints = 1 << 16;
    constexpr double kPlastic = 1.32471795724474602596;
    int hits = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double x = std::fmod(i / kPlastic, 1), y = std::fmod(i / (kPlastic * kPlastic), 1);
      Ray ray;
      ray.org = Vec3(static_cast<float>(2 * x - 1), static_cast<float>(2 * y - 1), 3);
      ray.dir = Vec3(0, 0, -1);
      hits += accel.occluded(ray);
    }
    return 4.0f * static_cast<float>(hits) / kPoints;
  }
};

TEST(Hair, StraightHairCoversItsAnalyticArea) {
  const auto line = hair_of(1, {-.5f, .2f, 0, .5f, .2f, 0}, {0, 6});
  EXPECT_NEAR(Placed(line).covered(), .2f + kPi * .01f, 2e-3f);
  // The equivalent cubic with evenly spaced points; its ends are flat.
  const auto cubic =
      hair_of(3, {-.5f, .2f, 0, -.5f / 3, .2f, 0, .5f / 3, .2f, 0, .5f, .2f, 0}, {0, 12});
  EXPECT_NEAR(Placed(cubic).covered(), .2f, 2e-3f);
}

TEST(Hair, RadiiOfVerticesTaper) {
  auto line = hair_of(1, {-.5f, 0, 0, .1f, .5f, 0, 0, .0f}, {0, 8});
  line.per_vertex = {{Kind::Radius, 1}};
  const float covered = Placed(line).covered();
  // The triangle, and about half of the cap at its thick end.
  EXPECT_GT(covered, .1f);
  EXPECT_NEAR(covered, .1f + kPi * .01f / 2, 4e-3f);
}

TEST(Hair, AHitLiesOnTheTubeWithItsNormalOutward) {
  const auto line = hair_of(1, {-.5f, 0, 0, 0, 0, 0, .5f, 0, 0}, {0, 9});
  const Placed straight(line);
  for (const float y : {-.09f, -.03f, 0.0f, .05f, .099f}) {
    SurfacePoint point{};
    ASSERT_TRUE(straight.hit(Vec3(.2f, y, 3), Vec3(0, 0, -1), point)) << y;
    const float z = std::sqrt(.01f - y * y);
    EXPECT_NEAR(point.p.x, .2f, 2e-4f);
    EXPECT_NEAR(point.p.y, y, 2e-4f);
    EXPECT_NEAR(point.p.z, z, 2e-4f);
    EXPECT_NEAR(dot(point.ns, Vec3(0, y, z) * 10), 1, 1e-4f);
    EXPECT_GT(normalize(point.dpdu).x, .999f);
    EXPECT_EQ(point.primitive, 1u);
    // Rays that leave the hair do not hit it again.
    EXPECT_FALSE(straight.accel.occluded(spawn_ray(point, point.ng, RayMask::All)));
  }
}

TEST(Hair, ACubicPassesTheCurveOfItsControlPoints) {
  const Vec3 c[4] = {{-.8f, -.5f, 0}, {-.3f, 1, 0}, {.2f, -.9f, .2f}, {.7f, .4f, 0}};
  std::vector<float> scalars;
  for (const Vec3& p : c) scalars.insert(scalars.end(), {p.x, p.y, p.z});
  auto hair = hair_of(3, scalars, {0, 12});
  hair.radius = .02f;
  const Placed placed(hair);
  for (const float t : {.1f, .25f, .5f, .66f, .9f}) {
    const float s = 1 - t;
    const Vec3 p =
        c[0] * (s * s * s) + c[1] * (3 * s * s * t) + c[2] * (3 * s * t * t) + c[3] * (t * t * t);
    SurfacePoint point{};
    ASSERT_TRUE(placed.hit(p + Vec3(0, 0, 2), Vec3(0, 0, -1), point)) << t;
    EXPECT_NEAR(length(point.p - p), .02f, 1e-3f);
  }
}

TEST(Hair, AQuadraticIsTheSameAsItsCubic) {
  const Vec3 q[3] = {{-.8f, -.5f, 0}, {0, 1, 0}, {.7f, .4f, 0}};
  Mesh quadratic;
  Diagnostics diagnostics;
  add_hair(quadratic, hair_of(2, {q[0].x, q[0].y, 0, q[1].x, q[1].y, 0, q[2].x, q[2].y, 0}, {0, 9}),
           diagnostics);
  ASSERT_EQ(quadratic.curves.points.size(), 4u);
  // Both at their middles.
  const auto& p = quadratic.curves.points;
  const Vec3 middle = (p[0].p + p[1].p * 3 + p[2].p * 3 + p[3].p) * .125f;
  EXPECT_LT(length(middle - (q[0] + q[1] * 2 + q[2]) * .25f), 1e-6f);
}

TEST(Hair, HairCoordinatesPrecedeVertexCoordinates) {
  auto line = hair_of(1, {.3f, .6f, -.5f, 0, 0, 0, .5f, 0, 0, 1}, {0, 10});
  line.per_hair = {{Kind::Texture, 2}};
  line.per_vertex = {{Kind::Texture, 1}};
  SurfacePoint point{};
  ASSERT_TRUE(Placed(line).hit(Vec3(.25f, 0, 3), Vec3(0, 0, -1), point));
  ASSERT_EQ(point.texture_count, 2u);
  EXPECT_LT(length(point.textures[0].coordinate - Vec3(.3f, .6f, 0)), 1e-6f);
  EXPECT_NEAR(point.textures[1].coordinate.x, .75f, 1e-3f);
}

TEST(Hair, AnInstanceMayStretchAndMoveIt) {
  const auto line = hair_of(1, {-.5f, 0, 0, .5f, 0, 0}, {0, 6});
  Mat4 to_world;
  to_world[0][0] = to_world[1][1] = to_world[2][2] = 2;
  to_world[3][0] = 5;
  SurfacePoint point{};
  ASSERT_TRUE(Placed(line, to_world).hit(Vec3(5.5f, .1f, 3), Vec3(0, 0, -1), point));
  EXPECT_LT(length(point.p - Vec3(5.5f, .1f, std::sqrt(.04f - .01f))), 1e-3f);
}

/// A mesh of those hairs, its keys for ray time 0 to 1.
Mesh moving(const std::vector<scene::Hair>& hairs) {
  Mesh mesh;
  Diagnostics diagnostics;
  for (const scene::Hair& hair : hairs) add_hair(mesh, hair, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  add_keys(mesh, 0, 1);
  return mesh;
}

/// Whether a ray along -z from (x, y) hits at that time, and the resulting point.
bool meets(const Accel& accel, float x, float y, float time, SurfacePoint* point = nullptr) {
  Ray ray{Vec3(x, y, 3), 0, Vec3(0, 0, -1)};
  ray.time = time;
  Hit hit;
  const bool met = accel.intersect(ray, hit);
  EXPECT_EQ(met, accel.occluded(ray));
  if (met && point) accel.interpolate(hit, *point);
  return met;
}

TEST(Hair, MotionVectorsMoveHair) {
  // Right by 4 in the first half, up by 2 in the second; for lines and for both kinds of curves.
  const std::vector<float> way = {4, 0, 0, 4, 2, 0};
  for (const int degree : {1, 2, 3})
    for (const bool of_hair : {false, true}) {
      std::vector<float> scalars;
      if (of_hair) scalars = way;
      for (int v = 0; v <= degree; ++v) {
        const auto at = static_cast<float>(v) / static_cast<float>(degree);
        scalars.insert(scalars.end(), {-.5f + at, .2f, 0});
        if (!of_hair) scalars.insert(scalars.end(), way.begin(), way.end());
      }
      auto hair = hair_of(degree, scalars, {0, static_cast<std::uint32_t>(scalars.size())});
      (of_hair ? hair.per_hair : hair.per_vertex) = {{Kind::Motion, 2}};
      Accel accel;
      Mat4 path_end;
      path_end.setTranslation(Imath::V3f(0, 0, 1));
      accel.add_instance({.mesh = accel.add_mesh(moving({hair})), .path = {Mat4(), path_end}});
      accel.commit();
      SurfacePoint point;
      EXPECT_TRUE(meets(accel, 0, .25f, 0)) << degree;
      EXPECT_FALSE(meets(accel, 0, .25f, .3f)) << degree;
      ASSERT_TRUE(meets(accel, 2, .25f, .25f, &point)) << degree;
      // On the tube after the motion of hair and instance, with the velocity of both.
      EXPECT_LT(length(point.p - Vec3(2, .25f, .25f + std::sqrt(.01f - sqr(.05f)))), 1e-3f);
      EXPECT_LT(length(point.speed - Vec3(8, 0, 1)), 1e-4f) << point.speed;
      EXPECT_FALSE(accel.occluded(spawn_ray(point, point.ng, RayMask::All)));
      ASSERT_TRUE(meets(accel, 4.1f, 1.2f, .75f, &point)) << degree;
      EXPECT_LT(length(point.speed - Vec3(0, 4, 1)), 1e-4f) << point.speed;
      EXPECT_FALSE(meets(accel, 4.1f, .2f, .75f)) << degree;
      EXPECT_TRUE(meets(accel, 4.1f, 2.2f, 1)) << degree;
    }
}

TEST(Hair, VertexVectorsOverrideHairVectors) {
  // The root is fixed and the tip moves; the vector of the hair would move both.
  auto hair = hair_of(1, {9, 9, 9, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 15});
  hair.per_hair = {{Kind::Motion, 1}};
  hair.per_vertex = {{Kind::Motion, 1}};
  hair.radius = .01f;
  Accel accel;
  accel.add_instance({.mesh = accel.add_mesh(moving({hair}))});
  accel.commit();
  for (const float time : {0.0f, .4f, 1.0f}) {
    SurfacePoint point;
    ASSERT_TRUE(meets(accel, .75f, .75f * time, time, &point));
    EXPECT_LT(length(point.speed - Vec3(0, .75f, 0)), 1e-2f) << point.speed;
    EXPECT_LT(length(normalize(point.dpdu) - normalize(Vec3(1, time, 0))), 1e-3f);
  }
}

TEST(Hair, BlocksWithFewerVectorsMoveAlike) {
  auto straight = hair_of(1, {0, 0, 0, 6, 0, 0, 0, 1, 0, 6, 0, 0}, {0, 12});
  straight.per_vertex = {{Kind::Motion, 1}};
  auto bent =
      hair_of(1, {0, 0, 1, 0, 3, 0, 0, 0, 3, 0, 3, 0, 0, 1, 1, 0, 3, 0, 0, 0, 3, 0, 3, 0}, {0, 24});
  bent.per_vertex = {{Kind::Motion, 3}};
  const auto still = hair_of(1, {0, 0, 2, 0, 1, 2}, {0, 6});
  const std::vector<scene::Hair> all = {straight, bent, still};
  for (const auto& order : {std::array{0, 1, 2}, {2, 1, 0}, {1, 0, 2}}) {
    const Mesh mesh =
        moving({all[static_cast<std::size_t>(order[0])], all[static_cast<std::size_t>(order[1])],
                all[static_cast<std::size_t>(order[2])]});
    ASSERT_EQ(mesh.curves.keys.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t block = 0; block < 3; ++block) {
          const Vec3 from = mesh.curves.points[2 * block + i].p;
          const Vec3 at = mesh.curves.keys[k][2 * block + i].p;
          const float third = static_cast<float>(k);
          const Vec3 bends[] = {Vec3(0), Vec3(0, 3, 0), Vec3(0, 0, 3), Vec3(0, 3, 0)};
          const Vec3 way = order[block] == 0   ? Vec3(2 * third, 0, 0)
                           : order[block] == 1 ? bends[k]
                                               : Vec3(0);
          EXPECT_LT(length(at - from - way), 1e-5f) << order[block] << ' ' << k;
        }
  }
}

TEST(Hair, BlocksKeepTheirSlotsAndBadHairsAreCounted) {
  Mesh mesh;
  Diagnostics diagnostics;
  auto lines = hair_of(1, {0, 0, 0, 1, 0, 0}, {0, 6});
  auto cubics = hair_of(3, {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 9}, {0, 12, 13});
  cubics.material = "m";
  add_hair(mesh, cubics, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-GEOM-023");
  add_hair(mesh, lines, diagnostics);
  ASSERT_EQ(mesh.slots.size(), 2u);
  // Lines are numbered before curves.
  EXPECT_EQ(mesh.slots[mesh.slot_of(0)].name, "");
  EXPECT_EQ(mesh.slots[mesh.slot_of(1)].name, "m");
}

}  // namespace hair_test
}  // namespace oriel::geom
