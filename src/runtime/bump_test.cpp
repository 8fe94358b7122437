// SPDX-License-Identifier: Apache-2.0
// The bump modes against normals worked out by hand.
#include "runtime/bump.h"

#include <gtest/gtest.h>

#include "runtime/world.h"
#include "support/expect_near.h"

namespace oriel {
namespace bump_test {

using testing::expect_near;

/// Object turned by 90 degrees about z (its x is world y) and stretched twofold along its x; camera
/// turned by 90 degrees about y (its z is world x).
struct Spaces : ::testing::Test {
  Spaces() {
    to_world = Mat4(0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1);
    to_object = to_world.inverse();
    world.camera.to_world = Mat4(0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 2, 3, 1);
    world.camera.to_camera = world.camera.to_world.inverse();
    point.to_world = &to_world;
    point.to_object = &to_object;
    point.world = &world;
    point.ray_direction = Vec3(0, 0, -1);
  }
  Mat4 to_world, to_object;
  World world;
  ShadingPoint point;
};
using BumpNormal = Spaces;

const Vec3 kUp(0, 0, 1);

// acceptance: B2
TEST_F(BumpNormal, AddsInEachSpace) {
  const Vec3 v(0.6f, 0, 0);
  expect_near(bump_normal(point, kUp, v, 1), normalize(Vec3(0.6f, 0, 1)), 1e-6f, "internal");
  expect_near(bump_normal(point, kUp, v, 2), normalize(Vec3(0.6f, 0, 1)), 1e-6f, "world");
  // A normal shrinks where the object stretches: .6 along object x is .3 along world y.
  expect_near(bump_normal(point, kUp, v, 3), normalize(Vec3(0, 0.3f, 1)), 1e-6f, "object");
  expect_near(bump_normal(point, kUp, v, 4), normalize(Vec3(0, 0, 0.4f)), 1e-6f, "camera");
  expect_near(bump_normal(point, kUp, Vec3(0, 0, 0.5f), 4), normalize(Vec3(0.5f, 0, 1)), 1e-6f,
              "camera");
}

// acceptance: B2
TEST_F(BumpNormal, SetsInEachSpace) {
  const Vec3 v(3, 0, 4);
  expect_near(bump_normal(point, kUp, v, 5), Vec3(0.6f, 0, 0.8f), 1e-6f, "internal");
  expect_near(bump_normal(point, kUp, v, 6), Vec3(0.6f, 0, 0.8f), 1e-6f, "world");
  expect_near(bump_normal(point, kUp, v, 7), normalize(Vec3(0, 1.5f, 4)), 1e-6f, "object");
  expect_near(bump_normal(point, kUp, v, 8), Vec3(0.8f, 0, -0.6f), 1e-6f, "camera");
}

// acceptance: B2
TEST_F(BumpNormal, NullVectorsAndUnknownModesLeaveTheNormal) {
  const Vec3 normal = normalize(Vec3(0.1f, 0.2f, 1));
  for (int mode = 0; mode <= 8; ++mode)
    expect_near(bump_normal(point, normal, Vec3(0), mode), normal, 1e-6f, "null");
  for (const int mode : {-1, 0, 9, 1000})
    expect_near(bump_normal(point, normal, Vec3(1, 0, 0), mode), normal, 1e-6f, "unknown mode");
}

TEST_F(BumpNormal, SetNormalsBelongToTheFront) {
  point.back_side = true;
  expect_near(bump_normal(point, kUp, Vec3(0, 0, -2), 6), kUp, 1e-6f, "seen from behind");
}

TEST_F(BumpNormal, SumsThatVanishLeaveTheNormal) {
  expect_near(bump_normal(point, kUp, Vec3(0, 0, -1), 2), kUp, 1e-6f, "opposite");
}

TEST_F(BumpNormal, ResultIsUnitForAnyVector) {
  for (int mode = 1; mode <= 8; ++mode)
    for (const float scale : {1e-6f, 1.0f, 1e6f})
      EXPECT_NEAR(length(bump_normal(point, kUp, Vec3(0.3f, -0.4f, 0.5f) * scale, mode)), 1, 1e-5)
          << mode << ' ' << scale;
}

TEST(FacingViewer, RotatesOnlyNormalsThatFaceAwayByTheMinimumAngle) {
  ShadingPoint point;
  point.ray_direction = Vec3(0, 0, -1);
  const Vec3 facing = normalize(Vec3(1, 2, 0.1f));
  EXPECT_EQ(facing_viewer(facing, point), facing);
  for (const Vec3& away :
       {Vec3(1, 0, 0), normalize(Vec3(1, 0, -0.5f)), normalize(Vec3(1, 1, -9))}) {
    const Vec3 n = facing_viewer(away, point);
    EXPECT_NEAR(length(n), 1, 1e-5);
    EXPECT_GT(dot(n, point.wo()), 0);
    EXPECT_LT(dot(n, point.wo()), 0.02f);
  }
}

TEST_F(BumpNormal, VectorsGiveTheNormalBack) {
  const Vec3 from = normalize(Vec3(.1f, -.2f, 1)), to = normalize(Vec3(-.4f, .3f, .8f));
  for (const bool back : {false, true})
    for (int mode = 1; mode <= 8; ++mode) {
      point.back_side = back;
      const Vec3 v = bump_vector(point, from, to, mode);
      expect_near(bump_normal(point, from, v, mode), to, 1e-6f, "there");
      if (mode <= 4) {
        EXPECT_EQ(bump_vector(point, from, from, mode), Vec3(0));
      }
    }
}

}  // namespace bump_test
}  // namespace oriel
