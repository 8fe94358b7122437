// SPDX-License-Identifier: Apache-2.0
#include "render/filter.h"

#include <gtest/gtest.h>

#include <string>

#include "sampling/sampler.h"

namespace oriel {
namespace filter_test {

using scene::FilterKind;

FilterSampler sampler_of(FilterKind kind, float width, float height) {
  return FilterSampler({kind, width, height});
}

/// Mean of t^power under the filter by the midpoint rule on a grid unlike the sampler's table.
double moment_of_filter(FilterKind kind, int power) {
  constexpr int kSteps = 100'003;
  double weight = 0, sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * 2 / kSteps - 1;
    const double f = filter_value(kind, static_cast<float>(t));
    weight += f;
    sum += f * std::pow(t, power);
  }
  return sum / weight;
}

/// Mean of g(offset) as the film forms it from marked and plain samples.
template <class G>
double filtered_mean(const FilterSampler& filter, const G& g) {
  constexpr std::uint32_t kSamples = 1 << 16;
  double plus = 0, minus = 0;
  int pluses = 0, minuses = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    sampling::Sampler sampler(3, 5, i);
    const auto offset = filter.sample(sampler.next_2d());
    (offset.negative ? minus : plus) += g(offset.pixels);
    ++(offset.negative ? minuses : pluses);
  }
  return filter.positive_share() * plus / pluses -
         (minuses ? filter.negative_share() * minus / minuses : 0.0);
}

class EveryFilter : public ::testing::TestWithParam<FilterKind> {};

TEST_P(EveryFilter, SamplesHaveTheMomentsOfTheFilter) {
  const FilterKind kind = GetParam();
  const float width = 3, height = 1.5f;
  const FilterSampler filter = sampler_of(kind, width, height);
  const double second = moment_of_filter(kind, 2), fourth = moment_of_filter(kind, 4);
  const double hx = width / 2, hy = height / 2;
  EXPECT_NEAR(filtered_mean(filter, [](Vec2 p) { return p.x; }), 0, 2e-3);
  EXPECT_NEAR(filtered_mean(filter, [](Vec2 p) { return p.y; }), 0, 2e-3);
  EXPECT_NEAR(filtered_mean(filter, [](Vec2 p) { return p.x * p.x; }), second * hx * hx, 2e-3);
  EXPECT_NEAR(filtered_mean(filter, [](Vec2 p) { return p.y * p.y; }), second * hy * hy, 2e-3);
  EXPECT_NEAR(filtered_mean(filter, [](Vec2 p) { return std::pow(p.x, 4); }),
              fourth * std::pow(hx, 4), 6e-3);
}

TEST_P(EveryFilter, PreservesConstantsExactly) {
  const FilterSampler filter = sampler_of(GetParam(), 4, 4);
  EXPECT_NEAR(filter.positive_share() - filter.negative_share(), 1, 1e-6);
}

TEST_P(EveryFilter, StaysWithinItsWidth) {
  const FilterSampler filter = sampler_of(GetParam(), 2.5f, 5);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    sampling::Sampler sampler(0, 0, i);
    const auto offset = filter.sample(sampler.next_2d());
    EXPECT_LE(std::abs(offset.pixels.x), 1.25f);
    EXPECT_LE(std::abs(offset.pixels.y), 2.5f);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryFilter,
                         ::testing::Values(FilterKind::Box, FilterKind::Triangle, FilterKind::Gauss,
                                           FilterKind::Mitchell, FilterKind::Lanczos,
                                           FilterKind::ClipMitchell, FilterKind::ClipLanczos));

TEST(Filter, HasTheClosedFormVariances) {
  EXPECT_NEAR(moment_of_filter(FilterKind::Box, 2), 1.0 / 3, 1e-4);
  EXPECT_NEAR(moment_of_filter(FilterKind::Triangle, 2), 1.0 / 6, 1e-4);
  // B = C = 1/3 is a third of the cubic B-spline (variance 1/3) and two thirds of Catmull-Rom,
  // which reproduces parabolas (variance 0); half the width is 2 pixels.
  EXPECT_NEAR(moment_of_filter(FilterKind::Mitchell, 2), (1.0 / 9) / 4, 1e-3);
}

TEST(Filter, OnlyMitchellAndLanczosHaveNegativeLobes) {
  for (const FilterKind kind : {FilterKind::Box, FilterKind::Triangle, FilterKind::Gauss})
    EXPECT_FALSE(sampler_of(kind, 3, 3).has_negative_lobes());
  for (const FilterKind kind : {FilterKind::Mitchell, FilterKind::Lanczos, FilterKind::ClipMitchell,
                                FilterKind::ClipLanczos})
    EXPECT_TRUE(sampler_of(kind, 4, 4).has_negative_lobes());
}

TEST(Filter, OnlyTheClipVariantsClip) {
  EXPECT_FALSE(sampler_of(FilterKind::Mitchell, 4, 4).clips());
  EXPECT_FALSE(sampler_of(FilterKind::Lanczos, 4, 4).clips());
  EXPECT_TRUE(sampler_of(FilterKind::ClipMitchell, 4, 4).clips());
  EXPECT_TRUE(sampler_of(FilterKind::ClipLanczos, 4, 4).clips());
}

}  // namespace filter_test
}  // namespace oriel
