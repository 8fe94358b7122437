// SPDX-License-Identifier: Apache-2.0
#include "lens/projection.h"

#include <gtest/gtest.h>

#include "support/expect_near.h"

namespace oriel::lens {
namespace projection_test {

using testing::expect_near;

constexpr float kDegree = kPi / 180;

TEST(LensProjection, ASphereUnrollsByLongitudeAndLatitude) {
  const auto at = [](float u, float v) { return spherical(Vec2(u, v), kTwoPi, kPi); };
  expect_near(at(.5f, .5f), Vec3(0, 0, -1), 2e-6f, "the middle looks ahead");
  expect_near(at(.75f, .5f), Vec3(1, 0, 0), 2e-6f, "a quarter to the right");
  expect_near(at(.25f, .5f), Vec3(-1, 0, 0), 2e-6f, "a quarter to the left");
  expect_near(at(0, .5f), at(1, .5f), 2e-6f, "both edges look behind");
  expect_near(at(.3f, 1), Vec3(0, 1, 0), 2e-6f, "the upper edge is the zenith");
  expect_near(at(.5f, .5f + 30.0f / 180), Vec3(0, .5f, -std::sqrt(.75f)), 2e-6f, "30 degrees up");
}

TEST(LensProjection, ACylinderKeepsVerticalLinesAndHeights) {
  const auto at = [](float u, float v) {
    return cylindrical(Vec2(u, v), kTwoPi, 2 * std::atan(2.0f));
  };
  // On a cylinder of radius 1 the picture height is linear from -2 to 2.
  for (const float v : {0.0f, .25f, .5f, .9f}) {
    const Vec3 d = at(.6f, v);
    EXPECT_NEAR(d.y / std::hypot(d.x, d.z), 4 * v - 2, 1e-5f);
    EXPECT_NEAR(std::atan2(d.x, -d.z), .1f * kTwoPi, 1e-6f) << "one column, one longitude";
  }
}

TEST(LensProjection, FisheyesFollowTheirLaws) {
  // Radius over the radius at the rim, of 60 degrees where the rim is at 90.
  const float t = 60 * kDegree, rim = 90 * kDegree;
  const struct {
    Fisheye mapping;
    float r;
  } laws[] = {{Fisheye::Equidistant, 2.0f / 3},
              {Fisheye::Equisolid, std::sin(t / 2) / std::sin(rim / 2)},
              {Fisheye::Stereographic, std::tan(t / 2) / std::tan(rim / 2)},
              {Fisheye::Orthographic, std::sin(t)}};
  for (const auto& law : laws) {
    const auto right = fisheye(Vec2(law.r, 0), law.mapping, rim);
    expect_near(*right, Vec3(std::sin(t), 0, -std::cos(t)), 2e-6f, "to the right");
    const auto up = fisheye(Vec2(0, law.r), law.mapping, rim);
    expect_near(*up, Vec3(0, std::sin(t), -std::cos(t)), 2e-6f, "up");
    expect_near(*fisheye(Vec2(0, 0), law.mapping, rim), Vec3(0, 0, -1), 2e-6f, "the middle");
    EXPECT_FALSE(fisheye(Vec2(.8f, .7f), law.mapping, rim)) << "outside of the rim";
  }
  EXPECT_NEAR(fisheye(Vec2(1, 0), Fisheye::Equidistant, kPi)->z, 1, 1e-6f) << "all around";
}

TEST(LensProjection, CubesShowTheirSixFaces) {
  const Vec3 axes[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (int face = 0; face < 6; ++face) {
    const auto f = static_cast<float>(face);
    expect_near(cube(Vec2(.5f, 1 - (f + .5f) / 6), CubeLayout::Column), axes[face], 2e-6f,
                "column");
    expect_near(cube(Vec2((f + .5f) / 6, .5f), CubeLayout::Row), axes[face], 2e-6f, "row");
    const Vec2 in_two((static_cast<float>(face % 3) + .5f) / 3, face < 3 ? .75f : .25f);
    expect_near(cube(in_two, CubeLayout::TwoRows), axes[face], 2e-6f, "two rows");
  }
}

TEST(LensProjection, FacesOfACubeMeetAtTheirEdges) {
  // The right edge of -z is the left one of x, that of x the left one of z; the upper edge of -z is
  // the lower one of the top.
  const float e = 1e-4f;
  const auto face = [](int k, float u, float v) {
    return cube(Vec2((static_cast<float>(k) + u) / 6, v), CubeLayout::Row);
  };
  for (const float v : {.1f, .5f, .8f}) {
    EXPECT_LT(length(face(4, 1 - e, v) - face(1, e, v)), 5 * e);
    EXPECT_LT(length(face(1, 1 - e, v) - face(5, e, v)), 5 * e);
    EXPECT_LT(length(face(5, 1 - e, v) - face(0, e, v)), 5 * e);
    EXPECT_LT(length(face(0, 1 - e, v) - face(4, e, v)), 5 * e);
    EXPECT_LT(length(face(4, v, 1) - face(3, v, 0)), 1e-5f);
    EXPECT_LT(length(face(4, v, 0) - face(2, v, 1)), 1e-5f);
  }
}

TEST(LensProjection, AnUprightBackKeepsVerticalsParallel) {
  const Vec3 up(0, 1, 0), forward = normalize(Vec3(.3f, .5f, -1));
  expect_near(normalize(upright(Vec2(0, 0), forward, up)), forward, 2e-6f, "the middle stays");
  // Points on a vertical line at a horizontal distance have the same x for every height h.
  const Vec3 axis = normalize(Vec3(.3f, 0, -1)), right = cross(axis, up);
  for (const float y : {-.4f, 0.0f, .7f}) {
    const Vec3 d = upright(Vec2(.25f, y), forward, up);
    EXPECT_NEAR(dot(d, axis), 1, 1e-6f);
    EXPECT_NEAR(dot(d, right), .25f, 1e-6f) << "vertical lines are columns of the film";
  }
}

}  // namespace projection_test
}  // namespace oriel::lens
