// SPDX-License-Identifier: Apache-2.0
// Moving meshes and instances: ray hits, and rays that leave them.
#include "geom/motion.h"

#include <gtest/gtest.h>

#include <random>

#include "base/parallel.h"
#include "geom/accel.h"

namespace oriel::geom {
namespace motion_test {

Mesh square(std::vector<std::vector<Vec3>> motion = {}) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, Vec3(0)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.slots.emplace_back();
  mesh.motion = std::move(motion);
  return mesh;
}

std::vector<Vec3> all(const Vec3& v) { return std::vector<Vec3>(4, v); }

Mat4 moved(float x, float y, float z) {
  Mat4 m;
  m.setTranslation(Imath::V3f(x, y, z));
  return m;
}

InstanceDesc instance_of(MeshId mesh, std::vector<Mat4> path = {}) {
  return {.mesh = mesh, .local_to_world = {}, .world_to_local = {}, .path = std::move(path)};
}

bool meets(const Accel& accel, float x, float y, float time) {
  Ray ray{Vec3(x, y, 1), 0, Vec3(0, 0, -1)};
  ray.time = time;
  Hit hit;
  const bool met = accel.intersect(ray, hit);
  EXPECT_EQ(met, accel.occluded(ray));
  EXPECT_TRUE(!met || hit.time == time);
  return met;
}

TEST(Motion, VectorsGiveThePositionAtEachStep) {
  Mesh mesh = square({all({1, 0, 0}), all({2, 4, 0})});
  add_keys(mesh, 0, 1);
  ASSERT_EQ(mesh.keys.size(), 3u);
  EXPECT_EQ(mesh.keys[0], mesh.positions);
  EXPECT_EQ(mesh.keys[1][1], Vec3(2, 0, 0));
  EXPECT_EQ(mesh.keys[2][1], Vec3(3, 4, 0));
  EXPECT_EQ(moved_corners(mesh, mesh.triangles[0], .75f)[0], Vec3(1.5f, 2, 0));
  EXPECT_EQ(speeds_at(mesh, mesh.triangles[0], .75f)[0], Vec3(2, 8, 0));
  // Extrapolated beyond the interval.
  add_keys(mesh, -1, 2);
  ASSERT_EQ(mesh.keys.size(), 7u);
  EXPECT_EQ(mesh.keys[0][0], Vec3(-2, 0, 0));
  EXPECT_EQ(mesh.keys[6][0], Vec3(4, 12, 0));
  EXPECT_EQ(mesh.motion.size(), 2u);
}

TEST(Motion, NullVectorsMoveNothing) {
  Mesh mesh = square({all(Vec3(0))});
  add_keys(mesh, 0, 1);
  EXPECT_TRUE(mesh.keys.empty());
  add_keys(mesh = square(), 0, 1);
  EXPECT_TRUE(mesh.keys.empty());
}

TEST(Motion, RaysHitMeshesAtRayTime) {
  Accel accel;
  Mesh mesh = square({all({10, 0, 0}), all({10, 10, 0})});
  add_keys(mesh, 0, 1);
  accel.add_instance(instance_of(accel.add_mesh(std::move(mesh))));
  accel.commit();
  EXPECT_TRUE(meets(accel, .5f, .5f, 0));
  EXPECT_FALSE(meets(accel, .5f, .5f, .2f));
  EXPECT_TRUE(meets(accel, 5.5f, .5f, .25f));
  EXPECT_TRUE(meets(accel, 10.5f, 5.5f, .75f));
  EXPECT_TRUE(meets(accel, 10.5f, 10.5f, 1));
  EXPECT_FALSE(meets(accel, 5.5f, 5.5f, .5f));
}

TEST(Motion, RaysHitInstancesAtRayTime) {
  Accel accel;
  Mesh mesh = square({all({0, 3, 0})});
  add_keys(mesh, 0, 1);
  // Its vertices move as well.
  accel.add_instance(
      instance_of(accel.add_mesh(std::move(mesh)), {Mat4(), moved(10, 0, 0), moved(10, 10, 0)}));
  accel.commit();
  EXPECT_TRUE(meets(accel, .5f, .5f, 0));
  EXPECT_TRUE(meets(accel, 10.5f, 2, .5f));
  EXPECT_FALSE(meets(accel, 10.5f, .5f, .5f));
  EXPECT_TRUE(meets(accel, 10.5f, 13.5f, 1));
  Hit hit;
  ASSERT_TRUE(accel.intersect({Vec3(10.5f, 2, 1), 0, Vec3(0, 0, -1), 9, RayMask::All, .5f}, hit));
  SurfacePoint point;
  accel.interpolate(hit, point);
  EXPECT_LT(length(point.p - Vec3(10.5f, 2, 0)), 1e-5f);
  EXPECT_EQ(point.time, .5f);
}

TEST(Motion, SpeedIsTheDisplacementBetweenTwoTimes) {
  Accel accel;
  Mesh mesh = square({{{1, 0, 0}, {2, 1, 0}, {0, 0, 3}, {0, 1, 1}}});
  add_keys(mesh, 0, 1);
  Mat4 turned;
  turned.setAxisAngle(Imath::V3f(1, 2, 3), .7f);
  accel.add_instance(
      instance_of(accel.add_mesh(std::move(mesh)), {Mat4(), turned * moved(3, 1, 2)}));
  accel.commit();
  constexpr float kStep = 1 / 64.0f;
  Hit hit{.u = .3f, .v = .5f, .instance = 0, .primitive = 1};
  SurfacePoint before, at, after;
  hit.time = .5f - kStep;
  accel.interpolate(hit, before);
  hit.time = .5f + kStep;
  accel.interpolate(hit, after);
  hit.time = .5f;
  accel.interpolate(hit, at);
  // For a product of two linear motions, the central difference is exact.
  EXPECT_LT(length((after.p - before.p) / (2 * kStep) - at.speed), 1e-4f);
  EXPECT_GT(length(at.speed), 1);
}

TEST(Motion, VertexNormalsTurnWithTheirTriangle) {
  // A square that rotates about its edge y = 0.
  Mesh mesh = square({{{0, 0, 0}, {0, 0, 0}, {0, -1, 1}, {0, -1, 1}}});
  const Vec3 tilted = normalize(Vec3(.2f, 0, 1));
  mesh.normals = all(tilted);
  add_keys(mesh, 0, 1);
  SurfacePoint point;
  interpolate(mesh, {.u = .2f, .v = .2f, .primitive = 0, .time = 1}, {}, point);
  EXPECT_LT(length(point.ng - Vec3(0, -1, 0)), 1e-6f);
  EXPECT_LT(length(point.ns - Vec3(tilted.x, -tilted.z, 0)), 1e-6f);
}

TEST(Motion, RaysDoNotHitTheirMovingOriginSurface) {
  flush_denormals();
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto in = [&](float lo, float hi) { return lo + (hi - lo) * uniform(generator); };
  const auto direction = [&] {
    Vec3 d;
    do d = Vec3(in(-1, 1), in(-1, 1), in(-1, 1));
    while (d.length2() > 1 || d.length2() < .01f);
    return normalize(d);
  };
  for (const bool moves : {false, true})
    for (const float far : {0.0f, 10.0f, 1000.0f, 1e5f}) {
      int bad = 0, met = 0;
      for (int scene = 0; scene < 40; ++scene) {
        Accel accel;
        Mesh mesh = square({all(direction() * (1 + far))});
        add_keys(mesh, 0, 1);
        std::vector<Mat4> path;
        for (int k = 0; moves && k < 3; ++k) {
          Mat4 m;
          m.setAxisAngle(Imath::V3f(direction()), in(0, 3));
          path.push_back(m * moved(in(-far, far), in(-far, far), in(-far, far)));
        }
        accel.add_instance(instance_of(accel.add_mesh(std::move(mesh)), path));
        accel.commit();
        for (int i = 0; i < 500; ++i) {
          Hit hit{
              .u = in(0, .5f), .v = in(0, .5f), .instance = 0, .primitive = 0, .time = in(0, 1)};
          SurfacePoint aim, point;
          accel.interpolate(hit, aim);
          const Vec3 d = direction();
          if (!accel.intersect({aim.p - d * 2, 0, d, 9, RayMask::All, hit.time}, hit)) continue;
          ++met;
          accel.interpolate(hit, point);
          const Vec3 out = direction();
          bad += accel.intersect(spawn_ray(point, out, RayMask::All), hit);
        }
      }
      EXPECT_GT(met, 10000) << far;
      EXPECT_EQ(bad, 0) << (moves ? "moving" : "still") << " instance, far " << far;
    }
}

}  // namespace motion_test
}  // namespace oriel::geom
