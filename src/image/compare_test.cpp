// SPDX-License-Identifier: Apache-2.0
#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "image/flip.h"

namespace oriel {
namespace compare_test {

TEST(Compare, MetricsMatchTheirFormulas) {
  Image reference(3, 2, 2, 1), test = reference;
  test.at(2, 1)[1] = 1.5f;
  test.at(0, 1)[0] = 0.9f;
  const Difference d = compare(test, reference);
  EXPECT_NEAR(d.rmse, std::sqrt((0.25 + 0.01) / 12), 1e-7);
  EXPECT_NEAR(d.mean_abs, 0.6 / 12, 1e-7);
  EXPECT_NEAR(d.relative_mse, (0.25 + 0.01) / 1.01 / 12, 1e-7);
  EXPECT_FLOAT_EQ(d.max_abs, 0.5f);
  EXPECT_EQ(d.max_x, 2);
  EXPECT_EQ(d.max_y, 1);
  EXPECT_EQ(d.max_channel, 1);
}

TEST(Compare, NonFiniteValuesAreCountedAndIgnored) {
  Image a(2, 1, 1, 3), b = a;
  a.pixels[0] = std::numeric_limits<float>::quiet_NaN();
  const Difference d = compare(a, b);
  EXPECT_EQ(d.not_finite, 1u);
  EXPECT_EQ(d.rmse, 0);
}

TEST(Compare, DifferentShapesAreRefused) {
  EXPECT_THROW(compare(Image(2, 2, 3), Image(2, 3, 3)), std::runtime_error);
  EXPECT_THROW(compare(Image(2, 2, 3), Image(2, 2, 4)), std::runtime_error);
  EXPECT_THROW(flip_error(Image(2, 2, 3), Image(2, 3, 3)), std::runtime_error);
}

TEST(Flip, SamePicturesHaveNoError) {
  Image image(20, 20, 3, 0.3f);
  image.at(4, 5)[0] = 0.9f;
  for (const float e : flip_error(image, image).pixels) ASSERT_EQ(e, 0);
}

// By hand from the published constants. L*a*b* (D65) of black and white differ by 100 in L alone;
// sRGB green is (87.735, -86.183, 83.180), blue (32.297, 79.188, -107.860), times L/100 in a and b.
TEST(Flip, FlatBlackAgainstWhiteHasTheValueOfTheFormulas) {
  const double green_l = 87.735, green_a = -86.183 * 0.87735, green_b = 83.180 * 0.87735;
  const double blue_l = 32.297, blue_a = 79.188 * 0.32297, blue_b = -107.860 * 0.32297;
  const double largest =
      std::pow(green_l - blue_l + std::hypot(green_a - blue_a, green_b - blue_b), 0.7);
  const double e = std::pow(100.0, 0.7);
  const double want = 0.95 + (e - 0.4 * largest) / (0.6 * largest) * 0.05;
  const Image map = flip_error(Image(16, 16, 3, 0), Image(16, 16, 3, 1));
  for (const float v : map.pixels) ASSERT_NEAR(v, want, 2e-4);
}

TEST(Flip, IsSymmetricAndGrowsWithTheDifference) {
  const Image grey(24, 24, 3, 0.5f);
  double last = 0;
  for (const float value : {0.52f, 0.6f, 0.8f, 1.0f}) {
    Image other = grey;
    for (int y = 8; y < 16; ++y)
      for (int x = 8; x < 16; ++x) std::fill_n(other.at(x, y), 3, value);
    const double there = mean_value(flip_error(other, grey));
    EXPECT_NEAR(there, mean_value(flip_error(grey, other)), 1e-6);
    EXPECT_GT(there, last);
    last = there;
  }
}

TEST(Flip, GrowsWithTheLevelOfNoise) {
  const Image grey(64, 64, 3, 0.5f);
  double last = 0;
  for (const float level : {0.01f, 0.03f, 0.1f, 0.3f}) {
    Image noisy = grey;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> noise(-level, level);
    for (float& v : noisy.pixels) v += noise(random);
    const double error = mean_value(flip_error(noisy, grey));
    EXPECT_GT(error, 1.5 * last) << level;
    last = error;
  }
  EXPECT_LT(last, 1);
}

TEST(Flip, FineNoiseCountsLessFromFarAway) {
  Image checker(64, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) std::fill_n(checker.at(x, y), 3, (x + y) % 2 ? 0.45f : 0.55f);
  const Image flat(64, 64, 3, 0.503f);
  EXPECT_LT(mean_value(flip_error(checker, flat, 120)),
            0.5 * mean_value(flip_error(checker, flat, 20)));
}

}  // namespace compare_test
}  // namespace oriel
