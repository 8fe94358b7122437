// SPDX-License-Identifier: Apache-2.0
#include "sampling/warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sampling/rectangle.h"
#include "sampling/sphere.h"
#include "sampling/testing/chi_square.h"

namespace oriel::sampling {
namespace warp_test {

constexpr int kCount = 100000;
// Six direction tests in this file share a significance of 0.01.
const double kLevel = testing::sidak(0.01, 6);

using Draw = std::function<std::optional<Vec3>(const Vec2&, float)>;

void expect_matches(const Draw& draw, const std::function<double(const Vec3&)>& pdf) {
  const auto r = testing::test_directions(draw, pdf, kCount, 3);
  EXPECT_GT(r.chi.p_value, kLevel) << "chi-square " << r.chi.statistic << " of " << r.chi.degrees;
  EXPECT_NEAR(r.pdf_integral, 1, 2e-3);
}

TEST(Warp, SineAndCosineMatchTheLibrary) {
  for (int i = 0; i <= 4096; ++i) {
    const float u = static_cast<float>(i) / 4096;
    const SinCos t = sincos_turns(u);
    EXPECT_NEAR(t.sin, std::sin(2 * M_PI * u), 3e-7);
    EXPECT_NEAR(t.cos, std::cos(2 * M_PI * u), 3e-7);
  }
}

TEST(Warp, SquareOfDiscInvertsTheDisc) {
  constexpr int kSide = 200;
  for (int i = 0; i <= kSide; ++i)
    for (int k = 0; k <= kSide; ++k) {
      const Vec2 u(static_cast<float>(i) / kSide, static_cast<float>(k) / kSide);
      const Vec2 back = square_of_disc(sample_disc(u));
      EXPECT_NEAR(back.x, u.x, 1e-6f) << u.x << " " << u.y;
      EXPECT_NEAR(back.y, u.y, 1e-6f) << u.x << " " << u.y;
    }
}

TEST(Warp, DirectionsMatchTheirDensity) {
  expect_matches([](const Vec2& u, float) { return sample_cosine_hemisphere(u); },
                 [](const Vec3& w) { return cosine_hemisphere_pdf(w.z); });
  expect_matches([](const Vec2& u, float) { return sample_uniform_sphere(u); },
                 [](const Vec3&) { return kUniformSpherePdf; });
  // The cone ends on a cell border (cos = 0.5), so the quadrature has no discontinuity.
  expect_matches([](const Vec2& u, float) { return sample_cone(u, 0.5f); },
                 [](const Vec3& w) { return w.z > 0.5f ? cone_pdf(0.5f) : 0; });
}

// The projected solid angle of the cap is pi (1 - least^2).
TEST(Warp, CapDirectionsMatchTheirDensity) {
  expect_matches([](const Vec2& u, float) { return sample_cosine_cap(u, 0.5f); },
                 [](const Vec3& w) { return w.z > 0.5f ? w.z * kInvPi / 0.75f : 0; });
  expect_matches([](const Vec2& u, float) { return sample_cosine_cap(u, 0); },
                 [](const Vec3& w) { return cosine_hemisphere_pdf(w.z); });
}

TEST(Warp, ConeResolvesTheSun) {
  const float radius_rad = 0.00465f;
  const float width = one_minus_cos(sqr(std::sin(radius_rad)));
  // physics: solid angle of the sun 6.79290e-5 sr.
  EXPECT_NEAR(1 / cone_pdf(width), 6.79290e-5f, 1e-9f);
  double mean = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const Vec3 w = sample_cone(Sampler(0, 0, i).next_2d(), width);
    const double r = std::hypot(w.x, w.y);
    EXPECT_LE(r, std::sin(radius_rad) * 1.00001);
    mean += r * r / 4096;
  }
  // Uniform in a small disc: the mean square radius is half the square of the edge.
  EXPECT_NEAR(mean / (0.00465 * 0.00465), 0.5, 1e-3);
}

TEST(Warp, DiscMatchesItsDensity) {
  constexpr int kRings = 8, kSectors = 16;
  std::vector<double> observed(kRings * kSectors);
  for (int n = 0; n < kCount; ++n) {
    const Vec2 p = sample_disc(Sampler(n, 1, 0).next_2d());
    const double r2 = p.x * p.x + p.y * p.y, phi = std::atan2(p.y, p.x) / (2 * kPi) + 0.5;
    ASSERT_LE(r2, 1.000001);
    const auto ring = std::min(static_cast<int>(r2 * kRings), kRings - 1);
    const auto sector = std::min(static_cast<int>(phi * kSectors), kSectors - 1);
    observed[static_cast<std::size_t>(ring * kSectors + sector)] += 1;
  }
  const std::vector<double> expected(observed.size(), double(kCount) / (kRings * kSectors));
  EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

TEST(Warp, TriangleIsUniformInArea) {
  // The four triangles between the edge midpoints have equal area.
  std::vector<double> observed(4);
  for (int n = 0; n < kCount; ++n) {
    const Vec2 b = sample_triangle(Sampler(n, 2, 0).next_2d());
    ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1.000001f);
    observed[b.x > 0.5f ? 0 : b.y > 0.5f ? 1 : b.x + b.y < 0.5f ? 2 : 3] += 1;
  }
  EXPECT_GT(testing::chi_square(observed, std::vector<double>(4, kCount / 4.0)).p_value, 0.01);
}

TEST(Heuristics, SharesSumToOne) {
  for (const float a : {1e-30f, 0.3f, 1.0f, 4e6f, 1e30f})
    for (const float b : {1e-30f, 0.3f, 7.0f, 1e30f}) {
      EXPECT_NEAR(balance_heuristic(a, b) + balance_heuristic(b, a), 1, 1e-6f);
      EXPECT_NEAR(power_heuristic(a, b) + power_heuristic(b, a), 1, 1e-6f);
    }
  EXPECT_EQ(power_heuristic(0, 1), 0);
  EXPECT_EQ(power_heuristic(1, 0), 1);
  EXPECT_EQ(power_heuristic(INFINITY, 3), 1);
  EXPECT_FLOAT_EQ(power_heuristic(1, 3), 0.1f);
  EXPECT_FLOAT_EQ(balance_heuristic(1, 3), 0.25f);
}

TEST(Rectangle, SolidAngleMatchesTheClosedForm) {
  const SphericalRectangle unit({0, 0, 0}, {-0.5f, -0.5f, 1}, {1, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(unit.solid_angle(), 0.8054317f, 1e-6f);
  const SphericalRectangle two({1, 2, 3}, {0, 1, 2}, {2, 0, 0}, {0, 2, 0});
  EXPECT_NEAR(two.solid_angle(), 2 * kPi / 3, 2e-6f);
  // A corner rectangle a x b at distance c: atan(a b / (c sqrt(a^2 + b^2 + c^2))).
  const SphericalRectangle corner({0, 0, 0}, {0, 0, -5}, {3, 0, 0}, {0, 0.5f, 0});
  EXPECT_NEAR(corner.solid_angle(), std::atan(1.5 / (5 * std::sqrt(9 + .25 + 25))), 1e-6);
}

TEST(Rectangle, SamplesAreUniformInSolidAngle) {
  const Vec3 corner(-0.5f, 0.4f, -0.3f), eu(0, 2, 0), ev(0.6f, 0, 0.8f);
  const SphericalRectangle rect({0, 0, 0.2f}, corner, eu, ev);
  // Each of 8 x 8 parts of the rectangle gets samples in proportion to its solid angle.
  constexpr int kCells = 8;
  std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
  double total = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const SphericalRectangle cell({0, 0, 0.2f},
                                    corner + eu * (i / float{kCells}) + ev * (j / float{kCells}),
                                    eu * (1.0f / kCells), ev * (1.0f / kCells));
      expected[static_cast<std::size_t>(i * kCells + j)] =
          double{kCount} * cell.solid_angle() / rect.solid_angle();
      total += cell.solid_angle();
    }
  EXPECT_NEAR(total, rect.solid_angle(), 2e-5);
  for (int n = 0; n < kCount; ++n) {
    const auto s = rect.sample(Sampler(n, 3, 0).next_2d());
    EXPECT_EQ(s.pdf, 1 / rect.solid_angle());
    const Vec3 p = s.point - corner;
    const float x = dot(p, eu) / dot(eu, eu), y = dot(p, ev) / dot(ev, ev);
    ASSERT_NEAR(length(p - eu * x - ev * y), 0, 1e-5);
    ASSERT_NEAR(length(Vec3(0, 0, 0.2f) + s.wi * s.distance - s.point), 0, 1e-5);
    const int i = std::clamp(static_cast<int>(x * kCells), 0, kCells - 1);
    const int j = std::clamp(static_cast<int>(y * kCells), 0, kCells - 1);
    observed[static_cast<std::size_t>(i * kCells + j)] += 1;
  }
  EXPECT_GT(testing::chi_square(observed, expected).p_value, kLevel);
}

/// Irradiance at the origin with normal +z from a rectangle of unit radiance.
double rectangle_irradiance(const Vec3& corner, const Vec3& eu, const Vec3& ev) {
  const SphericalRectangle rect({0, 0, 0}, corner, eu, ev);
  constexpr std::uint32_t kSamples = 1 << 14;
  double sum = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto s = rect.sample(Sampler(0, 0, i).next_2d());
    if (s.pdf > 0) sum += std::max(0.0f, s.wi.z) / s.pdf;
  }
  return sum / kSamples;
}

TEST(Rectangle, IrradianceMatchesTheFormFactor) {
  // Differential element to rectangle, form factor times pi.
  EXPECT_NEAR(rectangle_irradiance({-.5f, -.5f, 1}, {1, 0, 0}, {0, 1, 0}), .2394565 * kPi, 2e-4);
  EXPECT_NEAR(rectangle_irradiance({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), .5541264 * kPi, 4e-4);
  EXPECT_NEAR(rectangle_irradiance({-.5f, -.5f, 2}, {1, 0, 0}, {0, 1, 0}), .0734776 * kPi, 1e-4);
  EXPECT_NEAR(rectangle_irradiance({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), .1385316 * kPi, 2e-4);
  EXPECT_NEAR(rectangle_irradiance({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), .0557342 * kPi, 1e-4);
  // Far away (sampled by area): L A cos cos / d^2.
  EXPECT_NEAR(rectangle_irradiance({-.5f, -.5f, 100}, {1, 0, 0}, {0, 1, 0}) * 1e4, 1, 1e-4);
}

TEST(Rectangle, DensityIsContinuousWhereItTurnsToArea) {
  for (float z = 7; z < 18; z += 0.05f) {
    const Vec3 corner(3, 2, z);
    const SphericalRectangle rect({0, 0, 0}, corner, {1, 0, 0}, {0, 1, 0});
    const auto s = rect.sample({0.5f, 0.5f});
    EXPECT_NEAR(s.pdf * rect.solid_angle(), 1, 2e-3);
  }
}

TEST(Rectangle, TheSmallestKeepTheirLight) {
  // The sum of arcs is 0 or below for these.
  for (const float z : {1e2f, 1e3f, 1e4f, 1e5f})
    EXPECT_NEAR(rectangle_irradiance({-.5f, -.5f, z}, {1, 0, 0}, {0, 1, 0}) * double(z) * double(z),
                1, 1e-4);
}

TEST(Rectangle, InItsPlaneGivesNothing) {
  const SphericalRectangle rect({0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(rect.sample({0.3f, 0.6f}).pdf, 0);
}

TEST(SphereCone, SolidAngleIsTheCap) {
  EXPECT_NEAR(SphereCone({0, 0, 0}, {0, 0, 2}, 1).solid_angle(),
              2 * kPi * (1 - std::sqrt(3.0f) / 2), 1e-6f);
  EXPECT_NEAR(SphereCone({0, 0, 0}, {0, 0, 1e4f}, 1).solid_angle() * 1e8, kPi, 1e-5);
  EXPECT_NEAR(SphereCone({0, 0, 0.5f}, {0, 0, 0}, 1).solid_angle(), 4 * kPi, 1e-5);
}

TEST(SphereCone, DirectionsMatchTheirDensity) {
  const SphereCone cone({1, 2, 3}, {1, 2, 5}, std::sqrt(3.0f));  // half angle 60 degrees
  expect_matches([&](const Vec2& u, float) { return cone.sample(u); },
                 [&](const Vec3& w) { return w.z > 0.5f ? cone.pdf() : 0; });
}

TEST(SphereCone, IrradianceIsTheInverseSquare) {
  // pi L (R / d)^2 at a facing element, exact for any distance.
  const SphereCone cone({0, 0, 0}, {0, 0, 1}, 0.5f);
  double sum = 0;
  for (std::uint32_t i = 0; i < 4096; ++i)
    sum += cone.sample(Sampler(0, 0, i).next_2d()).z / cone.pdf() / 4096;
  EXPECT_NEAR(sum, 0.785398, 1e-4);
}

}  // namespace warp_test
}  // namespace oriel::sampling
