// SPDX-License-Identifier: Apache-2.0
#include "sampling/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sampling/sampler.h"
#include "sampling/testing/chi_square.h"

namespace oriel::sampling {
namespace triangle_test {

constexpr int kCount = 1 << 15;

struct Corners {
  Vec3 a, b, c;
};

/// By the sum of angles of a spherical triangle, which has no place in the code.
double solid_angle_of(const Corners& t, const Vec3& from) {
  const auto direction = [&](const Vec3& v) { return Imath::V3d(v - from).normalized(); };
  const Imath::V3d a = direction(t.a), b = direction(t.b), c = direction(t.c);
  const auto angle = [](const Imath::V3d& at, const Imath::V3d& p, const Imath::V3d& q) {
    return std::acos(std::clamp(at.cross(p).normalized().dot(at.cross(q).normalized()), -1., 1.));
  };
  return angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - M_PI;
}

/// Irradiance by a triangle of radiance 1 above the horizon: Lambert's sum over the edges.
/// Source: Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", section B.
double irradiance_of(const Corners& t, const Vec3& from, const Vec3& normal) {
  const Vec3 corners[] = {t.a - from, t.b - from, t.c - from};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Imath::V3d p(corners[i]), q(corners[(i + 1) % 3]);
    const Imath::V3d side = p.cross(q);
    sum += std::atan2(side.length(), p.dot(q)) * side.normalized().dot(Imath::V3d(normal)) / 2;
  }
  return std::abs(sum);
}

const Corners kWide{{-2, -1, 1}, {3, -1, 1.5f}, {0, 2, 2}},
    kThin{{-3, 0, 1}, {3, 0, 1}, {3, .02f, 1}}, kCorner{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    kSmall{{0, 0, 5}, {.1f, 0, 5}, {0, .1f, 5}};

TEST(Triangle, DensityIsOneOverTheSolidAngle) {
  EXPECT_NEAR(SphericalTriangle(Vec3(0), kCorner.a, kCorner.b, kCorner.c).pdf(Vec3(1), 1), 2 / kPi,
              1e-6f);
  for (const Corners& t : {kWide, kThin}) {
    const SphericalTriangle s(Vec3(0), t.a, t.b, t.c);
    ASSERT_FALSE(s.by_area());
    EXPECT_NEAR(double(s.pdf(Vec3(0, 0, 1), 1)) * solid_angle_of(t, Vec3(0)), 1, 1e-4);
  }
  EXPECT_TRUE(SphericalTriangle(Vec3(0), kSmall.a, kSmall.b, kSmall.c).by_area());
}

TEST(Triangle, SamplesAreUniformInSolidAngle) {
  // In parts of the triangle, by the barycentric coordinates of the samples.
  constexpr int kRows = 6;
  for (const Corners& t : {kWide, kThin, kCorner}) {
    const Vec3 from(.1f, -.2f, .05f), eu = t.b - t.a, ev = t.c - t.a;
    const SphericalTriangle triangle(from, t.a, t.b, t.c);
    ASSERT_FALSE(triangle.by_area());
    const auto place = [&](int i, int j) {
      return t.a + eu * (float(i) / kRows) + ev * (float(j) / kRows);
    };
    std::vector<double> observed(2 * kRows * kRows), expected(observed.size());
    const double whole = solid_angle_of(t, from);
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; i + j < kRows; ++j) {
        const auto cell = static_cast<std::size_t>(2 * (i * kRows + j));
        const Corners lower{place(i, j), place(i + 1, j), place(i, j + 1)},
            upper{place(i + 1, j + 1), place(i + 1, j), place(i, j + 1)};
        expected[cell] = kCount * solid_angle_of(lower, from) / whole;
        if (i + j + 1 < kRows) expected[cell + 1] = kCount * solid_angle_of(upper, from) / whole;
      }
    for (int n = 0; n < kCount; ++n) {
      const auto s = triangle.sample(Sampler(n, 5, 0).next_2d());
      ASSERT_NEAR(length(s.wi), 1, 1e-5);
      const Imath::V3d p(from + s.wi * s.distance - t.a), u(eu), v(ev), normal = u.cross(v);
      ASSERT_LT(std::abs(p.dot(normal.normalized())), 1e-4);
      const double x = p.cross(v).dot(normal) / normal.length2(),
                   y = u.cross(p).dot(normal) / normal.length2();
      ASSERT_GT(std::min({x, y, 1 - x - y}), -1e-3);
      const int i = std::clamp(static_cast<int>(x * kRows), 0, kRows - 1),
                j = std::clamp(static_cast<int>(y * kRows), 0, kRows - 1 - i);
      const bool is_upper = x * kRows - i + y * kRows - j > 1 && i + j + 1 < kRows;
      observed[static_cast<std::size_t>(2 * (i * kRows + j) + (is_upper ? 1 : 0))] += 1;
    }
    EXPECT_GT(testing::chi_square(observed, expected).p_value, .01);
  }
}

TEST(Triangle, IrradianceMatchesTheFormFactor) {
  for (const Corners& t : {kWide, kThin, kSmall}) {
    const Vec3 from(0), normal(0, 0, 1);
    const SphericalTriangle triangle(from, t.a, t.b, t.c);
    double sum = 0;
    for (std::uint32_t n = 0; n < kCount; ++n) {
      const auto s = triangle.sample(Sampler(3, 5, n).next_2d());
      ASSERT_GT(s.pdf, 0);
      EXPECT_FLOAT_EQ(s.pdf, triangle.pdf(s.wi, s.distance));
      sum += static_cast<double>(std::max(0.0f, s.wi.z) / s.pdf);
    }
    EXPECT_NEAR(sum / kCount / irradiance_of(t, from, normal), 1, 1e-3);
  }
}

TEST(Triangle, SeenEdgeOnHasNoSamples) {
  const SphericalTriangle triangle(Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 1, 0));
  EXPECT_EQ(triangle.sample(Vec2(.3f, .6f)).pdf, 0);
  EXPECT_EQ(triangle.pdf(Vec3(1, 0, 0), 1), 0);
}

}  // namespace triangle_test
}  // namespace oriel::sampling
