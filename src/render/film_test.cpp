// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <gtest/gtest.h>

#include <limits>

#include "sampling/sampler.h"

namespace oriel {
namespace {

FilterSampler box() { return FilterSampler(scene::PixelFilter{}); }
FilterSampler mitchell(bool clip) {
  using scene::FilterKind;
  return FilterSampler({clip ? FilterKind::ClipMitchell : FilterKind::Mitchell, 4, 4});
}

FilmSample sample_of(float grey) {
  FilmSample s;
  s.beauty = Rgb(grey);
  return s;
}

TEST(Film, ConstantStaysExactOverManySamples) {
  Film film(1, 1, box(), false);
  for (int i = 0; i < 65536; ++i) film.add(0, 0, sample_of(0.1f));
  EXPECT_EQ(film.pixel(0, 0).beauty.r, 0.1f);
  EXPECT_EQ(film.pixel(0, 0).variance.x, 0);
}

TEST(Film, VarianceIsThatOfTheMean) {
  // 1, 2, 3, 4: mean 2.5, sample variance 5/3, of the mean 5/12.
  Film film(1, 1, box(), false);
  for (const float v : {1.0f, 2.0f, 3.0f, 4.0f}) film.add(0, 0, sample_of(v));
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.g, 2.5f);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).variance.y, 5.0f / 12);
  EXPECT_FLOAT_EQ(film.level(0).mean, 2.5f);
  EXPECT_FLOAT_EQ(film.level(0).error, std::sqrt(5.0f / 12));
}

TEST(Film, ErrorIsUnknownBelowTwoSamples) {
  Film film(1, 1, box(), false);
  EXPECT_EQ(film.level(0).error, std::numeric_limits<float>::infinity());
  film.add(0, 0, sample_of(3));
  EXPECT_EQ(film.level(0).error, std::numeric_limits<float>::infinity());
  EXPECT_EQ(film.level(0).mean, 3);
}

TEST(Film, DepthIsTheMeanOverHits) {
  Film film(1, 1, box(), false);
  FilmSample s;
  film.add(0, 0, s);
  s.depth = 2;
  film.add(0, 0, s);
  s.depth = 4;
  film.add(0, 0, s);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).depth, 3);
}

TEST(Film, ValuesThatAreNoNumbersDoNotSpoilThePixel) {
  Film film(1, 1, box(), false);
  film.add(0, 0, sample_of(1));
  film.add(0, 0, sample_of(std::numeric_limits<float>::quiet_NaN()));
  film.add(0, 0, sample_of(std::numeric_limits<float>::infinity()));
  film.add(0, 0, sample_of(1));
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.r, 0.5f);
}

TEST(Film, NoiseIsJudgedOnWhatIsShown) {
  Film film(1, 1, box(), true);
  for (const float v : {10.0f, 20.0f}) {
    FilmSample s = sample_of(v);
    s.display = Rgb(1);
    film.add(0, 0, s);
  }
  EXPECT_EQ(film.level(0).error, 0);
  EXPECT_EQ(film.level(0).mean, 1);
  EXPECT_GT(film.pixel(0, 0).variance.x, 0);
}

TEST(Film, NegativeLobesSubtract) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter, false);
  film.add(0, 0, sample_of(0));
  FilmSample ring = sample_of(1);
  ring.negative = true;
  film.add(0, 0, ring);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.r, -filter.negative_share());
  EXPECT_EQ(film.samples(0, 0), 2u);
}

TEST(Film, ClipVariantsNeverGoBelowBlack) {
  Film film(1, 1, mitchell(true), false);
  film.add(0, 0, sample_of(0));
  FilmSample ring = sample_of(1);
  ring.negative = true;
  film.add(0, 0, ring);
  EXPECT_EQ(film.pixel(0, 0).beauty.r, 0);
}

TEST(Film, ConstantIsKeptByFiltersWithNegativeLobes) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter, false);
  for (std::uint32_t i = 0; i < 256; ++i) {
    sampling::Sampler sampler(0, 0, i);
    FilmSample s = sample_of(0.7f);
    s.alpha = 1;
    s.negative = filter.sample(sampler.next_2d()).negative;
    film.add(0, 0, s);
    EXPECT_NEAR(film.pixel(0, 0).beauty.r, 0.7f, 1e-6f);
    EXPECT_NEAR(film.pixel(0, 0).beauty.a, 1, 1e-6f);
  }
}

/// Share of 95 % intervals of the mean that hold the truth.
double coverage(int samples, bool negative_lobes) {
  const FilterSampler filter = negative_lobes ? mitchell(false) : box();
  constexpr int kSide = 100;
  Film film(kSide, kSide, filter, false);
  int held = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int i = 0; i < samples; ++i) {
        // Independent draws: a new pixel key for each, since samples of one pixel are stratified.
        sampling::Sampler sampler(x, y, 0, static_cast<std::uint32_t>(i) + 1);
        FilmSample s = sample_of(2 * sampler.next_1d() * sampler.next_1d() * 2);  // mean 1
        s.negative = filter.sample(sampler.next_2d()).negative;
        film.add(x, y, s);
      }
      const Film::Pixel p = film.pixel(x, y);
      held += std::abs(p.beauty.r - 1) <= 1.96f * std::sqrt(p.variance.x);
    }
  }
  return static_cast<double>(held) / (kSide * kSide);
}

TEST(Film, NinetyFivePercentIntervalsHoldTheTruth) {
  EXPECT_GT(coverage(64, false), 0.93);
  EXPECT_LT(coverage(64, false), 0.97);
  EXPECT_GT(coverage(128, true), 0.93);
  EXPECT_LT(coverage(128, true), 0.97);
}

}  // namespace
}  // namespace oriel
