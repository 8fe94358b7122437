// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oriel {
namespace measure_test {

/// Rare bright light: mean 1, standard deviation 3.
double rare(sampling::Sampler& sampler) { return sampler.next_1d() < .1f ? 10 : 0; }

/// Exponential: mean 1, skewness 2, from independent draws.
double skewed(sampling::Sampler& sampler) { return -std::log(1 - double{sampler.next_1d()}); }

TEST(MeasureStatistics, StudentsFactorIsThatOfTables) {
  // Abramowitz and Stegun, table 26.10, A = .95.
  const struct {
    double degrees, factor;
  } kTable[] = {{10, 2.228}, {20, 2.086}, {30, 2.042}, {60, 2.000}, {120, 1.980}};
  for (const auto& row : kTable) EXPECT_NEAR(student_95(row.degrees), row.factor, 6e-4);
  EXPECT_NEAR(student_95(1e9), 1.959964, 1e-6);
}

TEST(MeasureStatistics, NinetyFiveOfAHundredIntervalsHoldTheTruth) {
  // For n independent readings the number of correct intervals is binomial: four sigma are 4 sqrt(n
  // .95 .05).
  constexpr std::size_t kReadings = 2000;
  const double four_sigma = 4 * std::sqrt(kReadings * .95 * .05);
  const auto covered = [&](const auto& f, const MeasureRequest& request) {
    const auto readings = take_readings(
        kReadings, [&](std::size_t, sampling::Sampler& s, RayCounts&) { return f(s); }, request);
    int count = 0;
    for (const Reading& r : readings) count += std::abs(r.value - 1) <= r.half_width;
    return count;
  };
  // A fixed number of samples, and a number determined by the interval of each reading.
  const auto uneven = [](sampling::Sampler& s) { return skewed(s) * rare(s); };
  EXPECT_NEAR(covered(uneven, {.precision = 0, .max_samples = 2048}), .95 * kReadings, four_sigma);
  // Stopping by interval: with a long tail up to one more of a hundred fails.
  EXPECT_NEAR(covered(skewed, {.precision = .01}), .945 * kReadings, four_sigma + .005 * kReadings);
}

TEST(MeasureStatistics, ReadingsEndAtTheirPrecision) {
  const auto quantity = [](std::size_t i, sampling::Sampler& s, RayCounts&) {
    return i == 0 ? 7 : rare(s) * skewed(s);
  };
  const auto r = take_readings(2, quantity, {.precision = .05});
  EXPECT_TRUE(r[0].precise && r[1].precise);
  EXPECT_EQ(r[0].value, 7);
  EXPECT_EQ(r[0].samples, kFirstBatches * kBatchSamples);
  EXPECT_GT(r[1].samples, r[0].samples);
  EXPECT_LE(r[1].half_width, .05 * r[1].value);

  const auto few = take_readings(2, quantity, {.precision = .001, .max_samples = 1990});
  EXPECT_TRUE(few[0].precise);
  EXPECT_FALSE(few[1].precise);
  EXPECT_EQ(few[1].samples, 2000u);  // whole batches
  // Precise by absolute width, for any value.
  EXPECT_TRUE(take_readings(2, quantity, {.precision = 0, .floor = .3})[1].precise);
}

TEST(MeasureStatistics, ResultsDependOnSeedsAndOrderOnly) {
  const auto quantity = [](std::size_t, sampling::Sampler& s, RayCounts&) { return skewed(s); };
  const auto a = take_readings(3, quantity, {.precision = .02});
  const auto b = take_readings(3, quantity, {.precision = .02});
  const auto c = take_readings(3, quantity, {.precision = .02, .seed = 1});
  EXPECT_EQ(a[2].value, b[2].value);
  EXPECT_NE(a[2].value, c[2].value);
  EXPECT_NE(a[0].value, a[1].value);
}

TEST(MeasureStatistics, MeanOfReadingsHasAConfidenceInterval) {
  const Reading mean = mean_reading({{1, .3, 32, true}, {3, .4, 64, true}});
  EXPECT_DOUBLE_EQ(mean.value, 2);
  EXPECT_DOUBLE_EQ(mean.half_width, .25);
  EXPECT_EQ(mean.samples, 96u);
}

}  // namespace measure_test
}  // namespace oriel
