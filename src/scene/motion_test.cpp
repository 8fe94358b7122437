// SPDX-License-Identifier: Apache-2.0
// Shutters in ray time, and motion paths of nested instances.
#include "scene/motion.h"

#include <gtest/gtest.h>

namespace oriel::scene {
namespace motion_test {

Mat4 moved(float x, float y, float z) {
  Mat4 m;
  m.setTranslation(Imath::V3f(x, y, z));
  return m;
}

Mat4 turned(float degrees) {
  Mat4 m;
  m.setAxisAngle(Imath::V3f(0, 0, 1), degrees * kPi / 180);
  return m;
}

/// World to local, as in files.
Instance instance(const Mat4& from, const std::optional<Mat4>& to = std::nullopt) {
  Instance i;
  i.transform = from.inverse();
  if (to) i.motion_transform = to->inverse();
  return i;
}

Leaf leaf(const std::vector<const Instance*>& chain) {
  Leaf l;
  l.chain = chain;
  l.motion_world_to_local = Mat4();
  return l;
}

Shutter shutter(float delay, float close, int steps = 1) {
  return shutter_of({.on = true, .steps = steps, .delay = delay, .shutter = close});
}

void expect_at(const Mat4& m, const Vec3& local, const Vec3& world) {
  const Vec3 p = transform_point(local, m);
  EXPECT_LT(length(p - world), 1e-5f) << p << " " << world;
}

TEST(Shutter, OpensAndClosesWithinTheIntervalOrBeyond) {
  EXPECT_FALSE(shutter_of({}).on);
  const Shutter inside = shutter(.25f, .75f);
  EXPECT_EQ(inside.first, 0);
  EXPECT_EQ(inside.last, 1);
  EXPECT_EQ(inside.open, .25f);
  EXPECT_EQ(inside.close, .75f);
  EXPECT_EQ(inside.middle(), .5f);
  const Shutter beyond = shutter(-.5f, 2);
  EXPECT_EQ(beyond.first, -1);
  EXPECT_EQ(beyond.last, 2);
  EXPECT_FLOAT_EQ(beyond.scene_time(beyond.open), -.5f);
  EXPECT_FLOAT_EQ(beyond.scene_time(beyond.close), 2);
  // Closes before it opens, not a number, too far: still gives a valid shutter.
  EXPECT_EQ(shutter(.5f, .25f).close, .5f);
  EXPECT_EQ(shutter(NAN, 1e30f).last, 4);
  EXPECT_EQ(shutter(0, 1, 1000).steps, kMaxMotionSteps);
}

TEST(MotionPath, IsEmptyForStaticLeaves) {
  const Instance still = instance(Mat4()), moves = instance(Mat4(), moved(1, 0, 0));
  Leaf l = leaf({&still});
  l.motion_world_to_local.reset();
  EXPECT_TRUE(motion_path(l, shutter(0, 1)).empty());
  EXPECT_TRUE(motion_path(leaf({&moves}), Shutter{}).empty());
}

TEST(MotionPath, OneStepIsLinearAndMoreFollowTheRotation) {
  const Instance i = instance(Mat4(), turned(90));
  const auto straight = motion_path(leaf({&i}), shutter(0, 1));
  ASSERT_EQ(straight.size(), 2u);
  expect_at(straight[0], {1, 0, 0}, {1, 0, 0});
  expect_at(straight[1], {1, 0, 0}, {0, 1, 0});
  const auto round = motion_path(leaf({&i}), shutter(0, 1, 3));
  ASSERT_EQ(round.size(), 4u);
  expect_at(round[1], {1, 0, 0}, {std::cos(kPi / 6), std::sin(kPi / 6), 0});
  expect_at(round[2], {1, 0, 0}, {std::cos(kPi / 3), std::sin(kPi / 3), 0});
  expect_at(round[3], {1, 0, 0}, {0, 1, 0});
}

TEST(MotionPath, NestedInstancesMoveSeparately) {
  const Instance car = instance(moved(0, 0, 5), moved(3, 0, 5));
  const Instance wheel = instance(moved(0, 1, 0), turned(-90) * moved(0, 1, 0));
  const auto path = motion_path(leaf({&car, &wheel}), shutter(0, 1, 2));
  ASSERT_EQ(path.size(), 3u);
  expect_at(path[1], {0, 0, 0}, {1.5f, 1, 5});
  expect_at(path[1], {1, 0, 0}, {1.5f + std::sqrt(.5f), 1 - std::sqrt(.5f), 5});
}

TEST(MotionPath, StretchAndRotationInterpolateSeparately) {
  Mat4 wide;
  wide.setScale(Imath::V3f(2, 4, 1));
  Mat4 wider;
  wider.setScale(Imath::V3f(4, 4, 1));
  const Instance i = instance(wide, wider * turned(60));
  const auto path = motion_path(leaf({&i}), shutter(0, 1, 2));
  // Halfway: three wide, between two and four, rotated by half the angle.
  expect_at(path[1], {1, 0, 0}, Vec3(3 * std::cos(kPi / 6), 3 * std::sin(kPi / 6), 0));
}

TEST(MotionPath, ExtrapolatesOutsideTheInterval) {
  const Instance i = instance(moved(1, 0, 0), turned(30) * moved(2, 0, 0));
  const auto path = motion_path(leaf({&i}), shutter(-1, 2));
  ASSERT_EQ(path.size(), 4u);
  expect_at(path[0], {1, 0, 0}, {std::cos(kPi / 6), -.5f, 0});
  expect_at(path[3], {1, 0, 0}, {3 + .5f, std::sin(kPi / 3), 0});
}

TEST(MotionPath, MotionOffStopsTheInstanceAndThoseAbove) {
  const Instance above = instance(Mat4(), moved(1, 0, 0)), held = instance(Mat4(), moved(0, 1, 0)),
                 below = instance(Mat4(), moved(0, 0, 1));
  Leaf l = leaf({&above, &held, &below});
  l.first_moving = 2;
  const auto path = motion_path(l, shutter(0, 1));
  expect_at(path[1], {0, 0, 0}, {0, 0, 1});
}

}  // namespace motion_test
}  // namespace oriel::scene
