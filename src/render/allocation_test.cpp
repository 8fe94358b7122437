// SPDX-License-Identifier: Apache-2.0
#include "render/allocation.h"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

namespace oriel {
namespace allocation_test {

constexpr std::uint32_t kUnlimited = 1u << 20;

/// Half of the pixels have noise of variance .04, the others of variance 1.
std::vector<PixelDemand> two_kinds(std::uint32_t samples, std::size_t count = 1000) {
  std::vector<PixelDemand> pixels(count);
  for (std::size_t i = 0; i < count; ++i) pixels[i] = {samples, i % 2 ? 1.0f : .04f};
  return pixels;
}

double total(const std::vector<std::uint32_t>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0);
}

TEST(Allocation, SamplesAreProportionalToTheDeviationAndReachTheTarget) {
  // Deviations .2 and 1 with samples in proportion: (mean deviation)^2 / squared noise on average.
  const auto samples = allocate_samples(two_kinds(16), {.squared_noise = 1e-4,
                                                        .growth = kUnlimited,
                                                        .pixel_growth = kUnlimited,
                                                        .max_samples = kUnlimited});
  EXPECT_NEAR(total(samples) / 1000, .36 / 1e-4, .01 * .36 / 1e-4);
  EXPECT_NEAR(samples[0] / double(samples[1]), .2, .005);
  EXPECT_LE(.5 * (.04 / samples[0] + 1.0 / samples[1]), 1e-4);
}

TEST(Allocation, EndsAtTheGrowthOfAllPixels) {
  const auto samples = allocate_samples(
      two_kinds(64), {.growth = 1.5, .pixel_growth = 2, .max_samples = kUnlimited});
  EXPECT_EQ(samples[0], 64u);
  EXPECT_EQ(samples[1], 128u);
  EXPECT_EQ(total(samples), 96'000);
}

TEST(Allocation, PixelsKeepTheirLimitsAndBlocks) {
  std::vector<PixelDemand> pixels = two_kinds(48);
  pixels[4].variance = 0;
  pixels[5].samples = 90;
  const auto samples =
      allocate_samples(pixels, {.growth = kUnlimited, .pixel_growth = 3, .max_samples = 100});
  EXPECT_EQ(samples[4], 48u) << "without variance";
  EXPECT_EQ(samples[5], 100u);
  // The smallest number of blocks with (.04 / 48 + 1 / n) / 2 <= .006.
  for (const auto& [block, expected] : {std::pair(16u, 96u), std::pair(10u, 90u)}) {
    const auto some = allocate_samples(two_kinds(48), {.squared_noise = .006,
                                                       .growth = 9,
                                                       .pixel_growth = 9,
                                                       .max_samples = 1000,
                                                       .block = block});
    EXPECT_EQ(some[0], 48u);
    EXPECT_EQ(some[1], expected);
  }
}

TEST(Allocation, WithoutRoomOrVarianceNothingChanges) {
  std::vector<PixelDemand> pixels = two_kinds(64, 10);
  const AllocationLimits limits{.growth = 2, .pixel_growth = 2, .max_samples = 64};
  EXPECT_EQ(allocate_samples(pixels, limits), std::vector<std::uint32_t>(10, 64));
  for (PixelDemand& pixel : pixels) pixel.variance = 0;
  EXPECT_EQ(allocate_samples(pixels, {.growth = 2, .pixel_growth = 2, .max_samples = 640}),
            std::vector<std::uint32_t>(10, 64));
}

TEST(Allocation, OneBlockIsAddedWhereTheGrowthIsLess) {
  std::vector<PixelDemand> pixels(3, {16, 0});
  pixels[1].variance = 1;
  const auto samples =
      allocate_samples(pixels, {.growth = 1.1, .pixel_growth = 2, .max_samples = kUnlimited});
  EXPECT_EQ(samples, (std::vector<std::uint32_t>{16, 32, 16}));
}

TEST(Allocation, APassHasSamplesThoughItsTargetIsMet) {
  AllocationLimits limits{.squared_noise = 1, .growth = 2, .pixel_growth = 2, .max_samples = 1000};
  // All noisy pixels are equal and get their block at the same factor.
  EXPECT_EQ(total(allocate_samples(two_kinds(64), limits)), 500 * (64 + 80));
  limits.least_growth = 1.25;
  EXPECT_EQ(total(allocate_samples(two_kinds(64), limits)), 500 * (64 + 96));
}

/// A value of `value` at x 0, y 2 of 7 x 5 pixels, averaged over 3 x 3 pixels by `mean`: expected
/// at the pixel itself, in the rest of its column, in the next column.
void expect_window(void (*mean)(std::vector<float>&, int, int, int), float value, float itself,
                   float column, float next) {
  std::vector<float> values(7 * 5);
  values[2 * 7 + 0] = value;
  mean(values, 7, 5, 1);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      const bool near = x <= 1 && std::abs(y - 2) <= 1;
      const float expected = !near ? 0 : x == 1 ? next : y == 2 ? itself : column;
      EXPECT_FLOAT_EQ(values[static_cast<std::size_t>(y * 7 + x)], expected) << x << ' ' << y;
    }
}

TEST(BlurSquare, AveragesTheWindowInsideThePicture) {
  expect_window(blur_square, 18, 3, 3, 2);  // of 6 and 9 pixels
}

TEST(AverageNeighbours, LeavesOutThePixelAndWhatIsOutsideThePicture) {
  expect_window(average_neighbours, 40, 0, 8, 5);  // of 5 and 8 pixels
  std::vector<float> lone{3};
  average_neighbours(lone, 1, 1, 5);
  EXPECT_EQ(lone[0], 3);
}

}  // namespace allocation_test
}  // namespace oriel
