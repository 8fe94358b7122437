// SPDX-License-Identifier: Apache-2.0
// Intersections of rays with light shapes.
#include "geom/shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel::geom {
namespace shapes_test {

constexpr float kFar = 1e30f;

TEST(Shapes, RectanglesAreHitInsideTheirEdgesOnly) {
  const Rectangle shape{Vec3(1, 2, 3), Vec3(2, 0, 0), Vec3(1, 1, 0)};  // a parallelogram
  const auto hit = intersect(shape, Vec3(2.5f, 2.5f, 7), Vec3(0, 0, -2), 0, kFar);
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 2);
  EXPECT_EQ(hit->p, Vec3(2.5f, 2.5f, 3));
  EXPECT_EQ(hit->n, Vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(hit->uv.x, 0.75f);  // 1.5 = 2 a + b, 0.5 = b
  EXPECT_FLOAT_EQ(hit->uv.y, 0.75f);
  EXPECT_FALSE(intersect(shape, Vec3(-1.5f, 2.9f, 7), Vec3(0, 0, -1), 0, kFar));
  EXPECT_TRUE(intersect(shape, Vec3(-1.5f, 1.1f, 7), Vec3(0, 0, -1), 0, kFar));
  EXPECT_TRUE(intersect(shape, Vec3(1, 2, -7), Vec3(0, 0, 1), 0, kFar)) << "from behind";
  EXPECT_FALSE(intersect(shape, Vec3(1, 2, 7), Vec3(0, 0, -1), 0, 4)) << "tfar is outside";
  EXPECT_FALSE(intersect(shape, Vec3(1, 2, 7), Vec3(0, 0, -1), 4, kFar)) << "tnear is outside";
  EXPECT_FALSE(intersect(shape, Vec3(0, 0, 3), Vec3(1, 1, 0), 0, kFar)) << "within the plane";
  EXPECT_FALSE(intersect(Rectangle{}, Vec3(0, 0, 3), Vec3(0, 0, -1), 0, kFar));
}

TEST(Shapes, DiscsAreHitWithinTheirRadius) {
  const Disc shape{Vec3(0, 0, 5), Vec3(0, 2, 0), Vec3(3, 0, 0)};  // faces -z
  const auto hit = intersect(shape, Vec3(1.5f, 0, 0), Vec3(0, 0, 1), 0, kFar);
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 5);
  EXPECT_EQ(hit->n, Vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(hit->uv.x, 0.5f);
  EXPECT_FLOAT_EQ(hit->uv.y, 0.25f);
  EXPECT_TRUE(intersect(shape, Vec3(2.9f, 0, 0), Vec3(0, 0, 1), 0, kFar));
  EXPECT_FALSE(intersect(shape, Vec3(0, 2.1f, 0), Vec3(0, 0, 1), 0, kFar));
  EXPECT_FALSE(intersect(shape, Vec3(2.2f, 1.5f, 0), Vec3(0, 0, 1), 0, kFar));
}

TEST(Shapes, SpheresAreHitFromOutsideAndInside) {
  const Sphere shape{Vec3(0, 0, 10), 2};
  const auto outside = intersect(shape, Vec3(0), Vec3(0, 0, 4), 0, kFar);
  ASSERT_TRUE(outside);
  EXPECT_FLOAT_EQ(outside->t, 2);
  EXPECT_EQ(outside->n, Vec3(0, 0, -1));
  EXPECT_NEAR(outside->uv.y, 0, 1e-6f);
  const auto inside = intersect(shape, Vec3(0, 0, 9), Vec3(0, 0, 1), 0, kFar);
  ASSERT_TRUE(inside);
  EXPECT_FLOAT_EQ(inside->t, 3);
  EXPECT_FALSE(intersect(shape, Vec3(0), Vec3(0, 0, -1), 0, kFar));
  EXPECT_FALSE(intersect(shape, Vec3(2.01f, 0, 0), Vec3(0, 0, 1), 0, kFar));
  EXPECT_FALSE(intersect(Sphere{Vec3(0, 0, 10), 0}, Vec3(0), Vec3(0, 0, 1), 0, kFar));
}

TEST(Shapes, FarAndHugeSpheresKeepTheirDigits) {
  // At a distance of 1e4 radii the textbook discriminant has no significant digits.
  for (const float miss : {0.0f, 0.5f, 0.9f}) {
    const auto hit =
        intersect(Sphere{Vec3(0, 0, 1e4f), 1}, Vec3(miss, 0, 0), Vec3(0, 0, 1), 0, kFar);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->n.x, miss, 1e-3f);
    EXPECT_NEAR(hit->p.x, miss, 1e-3f);
  }
  EXPECT_FALSE(intersect(Sphere{Vec3(0, 0, 1e4f), 1}, Vec3(1.01f, 0, 0), Vec3(0, 0, 1), 0, kFar));
  const auto ground =
      intersect(Sphere{Vec3(0, 0, -6.4e6f), 6.4e6f}, Vec3(0, 0, 2), Vec3(0, 0, -1), 0, kFar);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->t, 2, 0.5f) << "half a unit in the last place of the radius";
}

TEST(Shapes, CylindersAreOpenTubes) {
  const Cylinder shape{Vec3(0, 0, 10), Vec3(3, 0, 0), 2};
  const auto hit = intersect(shape, Vec3(1.5f, 0, 0), Vec3(0, 0, 1), 0, kFar);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 8, 1e-5f);
  EXPECT_LT(length(hit->n - Vec3(0, 0, -1)), 1e-5f);
  EXPECT_NEAR(hit->uv.y, 0.75f, 1e-6f);
  EXPECT_FALSE(intersect(shape, Vec3(3.1f, 0, 0), Vec3(0, 0, 1), 0, kFar));
  EXPECT_FALSE(intersect(shape, Vec3(-9, 0, 10), Vec3(1, 0, 0), 0, kFar)) << "along the axis";
  const auto slanted = intersect(shape, Vec3(5, 0, 10), Vec3(-1, 0, 0.5f), 0, kFar);
  ASSERT_TRUE(slanted) << "in through the open end, onto the side from within";
  EXPECT_NEAR(slanted->t, 4, 1e-5f);
  EXPECT_FALSE(intersect(Cylinder{Vec3(0), Vec3(0), 1}, Vec3(3, 0, 0), Vec3(-1, 0, 0), 0, kFar));
}

TEST(Shapes, HitsLieOnTheRayAndOnTheShape) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto vector = [&] { return Vec3(unit(engine), unit(engine), unit(engine)); };
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 center = vector() * 10.0f, u = vector(), v = vector(), org = vector() * 10.0f;
    const Vec3 d = center + vector() * 0.7f - org;
    const float radius = 0.2f + std::abs(unit(engine));
    const auto check = [&](const std::optional<ShapeHit>& hit, auto&& distance) {
      if (!hit) return;
      ++hits;
      EXPECT_LT(length(org + d * hit->t - hit->p), 3e-4f);
      EXPECT_NEAR(length(hit->n), 1, 1e-5f);
      EXPECT_NEAR(distance(*hit), 0, 3e-5f);
      EXPECT_TRUE(hit->uv.x >= 0 && hit->uv.x <= 1 && hit->uv.y >= 0 && hit->uv.y <= 1);
    };
    const auto from_plane = [&](const ShapeHit& h) { return dot(h.p - center, h.n); };
    if (length(cross(u, v)) > 0.1f) {
      check(intersect(Rectangle{center, u, v}, org, d, 0, kFar), from_plane);
      check(intersect(Disc{center, u, v}, org, d, 0, kFar), from_plane);
    }
    check(intersect(Sphere{center, radius}, org, d, 0, kFar),
          [&](const ShapeHit& h) { return length(h.p - center) - radius; });
    check(intersect(Cylinder{center, u, radius}, org, d, 0, kFar), [&](const ShapeHit& h) {
      const Vec3 axis = normalize(u), r = h.p - center;
      return length(r - axis * dot(r, axis)) - radius;
    });
  }
  EXPECT_GT(hits, 3000);
}

}  // namespace shapes_test
}  // namespace oriel::geom
