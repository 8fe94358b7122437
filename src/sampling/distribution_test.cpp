// SPDX-License-Identifier: Apache-2.0
#include "sampling/distribution.h"

#include <gtest/gtest.h>

#include <vector>

#include "sampling/testing/chi_square.h"

namespace oriel::sampling {
namespace distribution_test {

constexpr int kCount = 100000;

TEST(ChiSquare, TailMatchesPublishedQuantiles) {
  // Abramowitz, Stegun table 26.8: upper 5 % and 1 % points.
  EXPECT_NEAR(testing::chi_square_tail(3.84146, 1), 0.05, 1e-5);
  EXPECT_NEAR(testing::chi_square_tail(18.3070, 10), 0.05, 1e-5);
  EXPECT_NEAR(testing::chi_square_tail(135.807, 100), 0.01, 1e-5);
  EXPECT_NEAR(testing::chi_square_tail(70.0649, 100), 0.99, 1e-5);
}

TEST(ChiSquare, RejectsAWrongDensity) {
  const auto r = testing::test_directions(
      [](const Vec2& u, float) -> std::optional<Vec3> {
        const float z = std::sqrt(u.x) * 0.98f;  // almost the cosine distribution
        const float s = std::sqrt(1 - z * z);
        return Vec3(s * std::cos(kTwoPi * u.y), s * std::sin(kTwoPi * u.y), z);
      },
      [](const Vec3& w) { return std::max(0.0f, w.z) * kInvPi; }, kCount, 1);
  EXPECT_LT(r.chi.p_value, 1e-6);
}

TEST(Distribution1D, SamplesMatchTheTable) {
  const std::vector<float> table{0.5f, 0, 3, 1, 0.01f, 0, 2.5f, 0};
  const Distribution1D d(table);
  EXPECT_FLOAT_EQ(d.integral(), 7.01f / 8);
  std::vector<double> observed(table.size()), expected;
  for (const float v : table) expected.push_back(v / 7.01 * kCount);
  for (int n = 0; n < kCount; ++n) {
    const auto s = d.sample(Sampler(n, 0, 0).next_1d());
    observed[s.index] += 1;
    EXPECT_EQ(s.pdf, d.pdf(s.x));
    EXPECT_FLOAT_EQ(s.pdf, table[s.index] / d.integral());
  }
  EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

TEST(Distribution1D, ChoiceLeavesAFreshNumber) {
  const std::vector<float> table{1, 3, 0, 4};
  const Distribution1D d(table);
  std::vector<double> observed(8);
  for (int n = 0; n < kCount; ++n) {
    const auto c = d.choose(Sampler(n, 1, 0).next_1d());
    EXPECT_FLOAT_EQ(c.pmf, table[c.index] / 8);
    ASSERT_TRUE(c.u >= 0 && c.u < 1);
    observed[static_cast<std::size_t>(c.u * 8)] += 1;
  }
  EXPECT_GT(testing::chi_square(observed, std::vector<double>(8, kCount / 8.0)).p_value, 0.01);
}

TEST(Distribution1D, NeverPicksAnEmptyCell) {
  for (const auto& table : {std::vector<float>{0, 0, 1, 0, 0}, {0, 1e-30f, 0}, {1, 0}, {0, 1}}) {
    const Distribution1D d(table);
    for (const float u : {0.0f, 1e-7f, 0.5f, 0x1.fffffep-1f}) {
      const auto s = d.sample(u);
      EXPECT_GT(table[s.index], 0);
      EXPECT_LT(s.x, 1);
    }
  }
}

TEST(Distribution1D, WithoutWeightIsUniform) {
  const Distribution1D d(std::vector<float>{0, -1, NAN, 0});
  EXPECT_EQ(d.integral(), 0);
  EXPECT_EQ(d.choose(0.6f).index, 2u);
  EXPECT_EQ(d.sample(0.6f).pdf, 1);
  EXPECT_EQ(d.pmf(1), 0.25f);
}

std::vector<float> picture(std::size_t width, std::size_t height) {
  std::vector<float> p;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      p.push_back(y == 2 ? 0.0f : static_cast<float>(x * x % 7) + 10.0f * (x == 5 && y == 3));
  return p;
}

TEST(Distribution2D, SamplesMatchTheTable) {
  constexpr std::size_t kWidth = 16, kHeight = 9;
  const auto p = picture(kWidth, kHeight);
  const Distribution2D d(p, kWidth, kHeight);
  double sum = 0;
  for (const float v : p) sum += v;
  EXPECT_NEAR(d.integral(), sum / p.size(), 1e-5);
  std::vector<double> observed(p.size()), expected;
  for (const float v : p) expected.push_back(v / sum * kCount);
  for (int n = 0; n < kCount; ++n) {
    const auto s = d.sample(Sampler(n, 2, 0).next_2d());
    const auto x = static_cast<std::size_t>(s.uv.x * kWidth);
    const auto y = static_cast<std::size_t>(s.uv.y * kHeight);
    observed[y * kWidth + x] += 1;
    EXPECT_EQ(s.pdf, d.pdf(s.uv));
  }
  EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

TEST(Distribution2D, PdfIntegratesToOne) {
  const Distribution2D d(picture(31, 17), 31, 17);
  double sum = 0;
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 31; ++x)
      sum += d.pdf(Vec2((float(x) + 0.5f) / 31, (float(y) + 0.5f) / 17)) / (31.0 * 17.0);
  EXPECT_NEAR(sum, 1, 1e-5);
}

}  // namespace distribution_test
}  // namespace oriel::sampling
