// SPDX-License-Identifier: Apache-2.0
#include "sampling/facing_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sampling/octahedral.h"
#include "sampling/sampler.h"

namespace oriel::sampling {
namespace facing_distribution_test {

constexpr std::size_t kSide = 64;

/// An uneven table: value 0 to 8 by the place, with a small bright cell and a black band.
std::vector<float> table(std::size_t side) {
  std::vector<float> values(side * side);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t x = i % side, y = i / side;
    values[i] = y == side / 3 ? 0 : static_cast<float>((x * 7 + y * 3) % 9);
  }
  values[side * (side / 2) + side / 5] = 900;
  return values;
}

Vec3 direction_of(std::size_t cell) {
  return octahedral_direction(
      Vec2(static_cast<float>(cell % kSide) + 0.5f, static_cast<float>(cell / kSide) + 0.5f) /
      static_cast<float>(kSide));
}

const Vec3 kNormals[] = {Vec3(0),
                         Vec3(1, 0, 0),
                         Vec3(0, -1, 0),
                         Vec3(0, 0, 1),
                         Vec3(0, 0, -1),
                         normalize(Vec3(.31f, -.7f, .2f)),
                         normalize(Vec3(-.5f, -.49f, -.51f))};

TEST(FacingDistribution, SamplesFollowTheDensity) {
  for (const std::size_t side : {std::size_t{16}, kSide}) {
    const FacingDistribution distribution(table(side), side);
    for (const Vec3& normal : kNormals) {
      // Expected and drawn shares of strips of rows; by the density the expected ones sum to 1.
      std::vector<double> drawn(8, 0), expected(8, 0);
      constexpr int kDraws = 20000;
      for (int i = 0; i < kDraws; ++i) {
        const auto s = distribution.sample(normal, Sampler(i, 0, 0).next_2d());
        ASSERT_LT(s.index, side * side);
        ASSERT_EQ(distribution.cell(s.uv), s.index);
        ASSERT_NEAR(distribution.pdf(normal, s.index) / s.pdf, 1, 1e-5);
        drawn[s.index / side * 8 / side] += 1.0 / kDraws;
      }
      double total = 0;
      for (std::size_t cell = 0; cell < side * side; ++cell) {
        const double share =
            static_cast<double>(distribution.pdf(normal, cell)) / static_cast<double>(side * side);
        total += share;
        expected[cell / side * 8 / side] += share;
      }
      EXPECT_NEAR(total, 1, 1e-4);
      // Four standard errors of a share.
      for (std::size_t k = 0; k < drawn.size(); ++k)
        EXPECT_NEAR(drawn[k], expected[k], 4 * std::sqrt(.25 / kDraws)) << normal << k;
    }
  }
}

TEST(FacingDistribution, AcceptsNormalsThatAreNoNumbers) {
  const FacingDistribution distribution(table(kSide), kSide);
  const float none = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const Vec3& normal : {Vec3(none), Vec3(0, none, 1), Vec3(infinite, 0, 0), Vec3(1e30f)}) {
    const auto s = distribution.sample(normal, Vec2(.3f, .6f));
    EXPECT_LT(s.index, kSide * kSide);
    EXPECT_FLOAT_EQ(distribution.pdf(normal, s.index), s.pdf);
  }
}

TEST(FacingDistribution, IsInProportionToValueAndCosine) {
  const std::vector<float> values = table(kSide);
  const FacingDistribution distribution(values, kSide);
  for (const Vec3& normal : kNormals) {
    // The mean square of value x cosine / density, relative to the square of the mean: 1 if in
    // proportion. By the values alone it is 2 to 5 here.
    double mean = 0, square = 0;
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      const float cosine = normal == Vec3(0) ? 1 : std::max(0.0f, dot(direction_of(cell), normal));
      const double f = static_cast<double>(values[cell] * cosine);
      if (!(f > 0)) continue;
      const double p = static_cast<double>(distribution.pdf(normal, cell));
      ASSERT_GT(p, 0) << normal;
      mean += f;
      square += f * f / p;
    }
    const double n = static_cast<double>(values.size());
    EXPECT_LT(square / n / (mean / n * (mean / n)), 1.25) << normal;
  }
}

}  // namespace facing_distribution_test
}  // namespace oriel::sampling
