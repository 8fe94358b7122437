// SPDX-License-Identifier: Apache-2.0
#include "transport/direction_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sampling/sampler.h"
#include "sampling/testing/chi_square.h"

namespace oriel {
namespace direction_guide_test {

/// Light that differs between all cells, and is 0 in some.
GuideSquare uneven() {
  GuideSquare light;
  for (std::size_t i = 0; i < kGuideCells; ++i) light[i] = float((i * i) % 7) * float(i % 3);
  return light;
}

Vec2 centre(std::size_t cell) {
  return Vec2((float(cell % kGuideSide) + 0.5f) / kGuideSide,
              (float(cell / kGuideSide) + 0.5f) / kGuideSide);
}

TEST(GuideDensity, FollowsTheLightAndIsOneOnTheAverage) {
  const GuideSquare light = uneven();
  const GuideDensity density(light);
  double mean_light = 0, mean = 0;
  for (const float l : light) mean_light += l / double(kGuideCells);
  for (std::size_t i = 0; i < kGuideCells; ++i) {
    const double expected = GuideDensity::kUnguided + (1 - GuideDensity::kUnguided) *
                                                          static_cast<double>(light[i]) /
                                                          mean_light;
    EXPECT_NEAR(density.at(centre(i)), expected, 1e-5 * expected) << i;
    mean += density.at(centre(i)) / double(kGuideCells);
  }
  EXPECT_NEAR(mean, 1, 1e-6);
}

TEST(GuidePoint, AveragesRays) {
  GuidePoint few, many;
  few.rays = 64;
  few.light[3] = 8;
  few.mean = Rgb(1, 2, 3);
  many.rays = 192;
  many.light[3] = 4;
  many.light[7] = 2;
  many.mean = Rgb(5, 2, 7);
  few.add(many);
  EXPECT_EQ(few.rays, 256);
  EXPECT_FLOAT_EQ(few.light[3], 5);
  EXPECT_FLOAT_EQ(few.light[7], 1.5f);
  EXPECT_EQ(few.light[0], 0);
  EXPECT_FLOAT_EQ(few.mean.x, 4);
  EXPECT_FLOAT_EQ(few.mean.y, 2);
  EXPECT_FLOAT_EQ(few.mean.z, 6);
}

TEST(GuideDensity, IsUniformWithoutLight) {
  const GuideDensity density(GuideSquare{});
  float d = 0;
  const Vec2 at = density.sample(Vec2(.3f, .7f), d);
  EXPECT_EQ(d, 1);
  EXPECT_NEAR(at.x, .3f, 1e-6f);
  EXPECT_NEAR(at.y, .7f, 1e-6f);
}

TEST(GuideDensity, SamplesMatchIt) {
  const GuideDensity density(uneven());
  constexpr int kSamples = 1 << 18;
  std::vector<double> found(kGuideCells), expected(kGuideCells);
  sampling::Sampler sampler(1, 2, 0, 3);
  for (int i = 0; i < kSamples; ++i) {
    float d = 0;
    sampler.start(i, 2, 0, 3);
    const Vec2 at = density.sample(sampler.next_2d(), d);
    ASSERT_EQ(d, density.at(at));
    ++found[guide_cell(at)];
  }
  double chi2 = 0;
  for (std::size_t i = 0; i < kGuideCells; ++i) {
    const double e = double(density.at(centre(i))) * kSamples / double(kGuideCells);
    chi2 += (found[i] - e) * (found[i] - e) / e;
  }
  // 255 degrees of freedom: above 330.5 in one of 1000 cases.
  EXPECT_LT(chi2, 330.5);
}

TEST(LocalGuide, DirectionsMatchTheirDensity) {
  const GuideDensity density(uneven());
  for (const Vec3& n : {Vec3(0, 0, 1), normalize(Vec3(.5f, -.7f, .2f)), Vec3(0, -1, 0)}) {
    const LocalGuide guide(density, guide_frame(n));
    const auto r = testing::test_directions(
        [&](const Vec2& u, float) { return std::optional(guide.sample(u).wi); },
        [&](const Vec3& w) {
          const float cosine = dot(w, n);
          return cosine > 0 ? double(guide.density(w) * cosine * kInvPi) : 0.0;
        },
        100000, 3);
    EXPECT_GT(r.chi.p_value, testing::sidak(0.01, 3));
    EXPECT_NEAR(r.pdf_integral, 1, 5e-3);
  }
}

/// A point whose light comes through one cell.
GuidePoint point_of(const Vec3& position, const Vec3& normal, std::size_t cell) {
  GuidePoint p{position, normal};
  p.light[cell] = 1;
  p.mean = Rgb(float(cell), 1, 0);
  return p;
}

TEST(DirectionGuide, APlaceHasTheLightOfItsPoints) {
  // Two clusters of many points on a floor, and one on the ceiling above the first.
  std::vector<GuidePoint> points;
  for (int i = 0; i < 40; ++i) {
    const float y = float(i % 8) * .1f;
    points.push_back(point_of(Vec3(-1, y, 0), Vec3(0, 0, 1), 3));
    points.push_back(point_of(Vec3(1, y, 0), Vec3(0, 0, 1), 70));
    points.push_back(point_of(Vec3(-1, y, 1), Vec3(0, 0, -1), 200));
  }
  const DirectionGuide guide(points);
  const auto brightest = [&](const Vec3& position, const Vec3& normal) {
    const LocalGuide local = guide.at(position, normal);
    const Frame frame = guide_frame(normal);
    std::size_t best = 0;
    float most = 0;
    for (std::size_t i = 0; i < kGuideCells; ++i) {
      const Vec3 w = frame.to_world(sampling::sample_cosine_hemisphere(centre(i)));
      if (local.density(w) > most) most = local.density(w), best = i;
    }
    EXPECT_GT(most, 30);
    EXPECT_NEAR(local.light().y, 1, 1e-3f);
    EXPECT_NEAR(local.light().x / float(best), 1, .15f) << "the points of the cell, not all";
    return best;
  };
  EXPECT_EQ(brightest(Vec3(-.9f, .3f, 0), Vec3(0, 0, 1)), 3u);
  EXPECT_EQ(brightest(Vec3(.9f, .3f, 0), Vec3(0, 0, 1)), 70u);
  EXPECT_EQ(brightest(Vec3(-.9f, .3f, 1), Vec3(0, 0, -1)), 200u);
  EXPECT_EQ(brightest(Vec3(5, 5, 5), normalize(Vec3(.1f, 0, -1))), 200u) << "outside";
}

TEST(DirectionGuide, NeighbouringDirectionsShareTheirLight) {
  const std::vector<GuidePoint> points(1, point_of(Vec3(0), Vec3(0, 0, 1), 5 * kGuideSide + 7));
  const DirectionGuide guide(points);
  const LocalGuide local = guide.at(Vec3(0), Vec3(0, 0, 1));
  const auto guided = [&](std::size_t row, std::size_t column) {
    const Vec3 w =
        guide_frame(Vec3(0, 0, 1))
            .to_world(sampling::sample_cosine_hemisphere(centre(row * kGuideSide + column)));
    return local.density(w) - GuideDensity::kUnguided;
  };
  // Weights 4, 2 and 1 of 16.
  constexpr float kAll = (1 - GuideDensity::kUnguided) * kGuideCells;
  EXPECT_NEAR(guided(5, 7), kAll / 4, 1e-2f);
  EXPECT_NEAR(guided(4, 7), kAll / 8, 1e-2f);
  EXPECT_NEAR(guided(6, 8), kAll / 16, 1e-2f);
  EXPECT_NEAR(guided(5, 9), 0, 1e-2f);
}

TEST(DirectionGuide, WithoutPointsIsEmpty) {
  EXPECT_TRUE(DirectionGuide(std::span<const GuidePoint>()).empty());
}

TEST(DirectionGuide, FramesTurnSmoothly) {
  // Walls whose normals differ by rounding have the same frame.
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0)}) {
    const Frame a = guide_frame(n);
    for (const Vec3& e : {Vec3(1e-6f, 1e-6f, 1e-6f), Vec3(-1e-6f, 1e-6f, -1e-6f)}) {
      const Frame b = guide_frame(normalize(n + e));
      EXPECT_GT(dot(a.s, b.s), .9999f);
      EXPECT_GT(dot(a.t, b.t), .9999f);
    }
  }
}

}  // namespace direction_guide_test
}  // namespace oriel
