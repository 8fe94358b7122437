// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <gtest/gtest.h>

#include <set>

#include <limits>

#include "sampling/sampler.h"

namespace oriel {
namespace film_test {

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
  Film film(1, 1, box());
  for (int i = 0; i < 65536; ++i) film.add(0, 0, sample_of(0.1f));
  EXPECT_EQ(film.pixel(0, 0).beauty.r, 0.1f);
  EXPECT_EQ(film.pixel(0, 0).variance.x, 0);
}

TEST(Film, VarianceIsThatOfTheMean) {
  // 1, 2, 3, 4: mean 2.5, sample variance 5/3, of the mean 5/12.
  Film film(1, 1, box());
  for (const float v : {1.0f, 2.0f, 3.0f, 4.0f}) film.add(0, 0, sample_of(v));
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.g, 2.5f);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).variance.y, 5.0f / 12);
  EXPECT_FLOAT_EQ(film.estimate(0).mean, 2.5f);
  EXPECT_FLOAT_EQ(film.estimate(0).error, std::sqrt(5.0f / 12));
}

// Squares of such samples exceed the largest number.
TEST(Film, BrightSamplesHaveAFiniteVariance) {
  const float most = std::numeric_limits<float>::max();
  for (const float bright : {1e20f, 1e30f, most, -most}) {
    Film film(1, 1, box());
    for (int i = 0; i < 64; ++i)
      film.add(0, 0, sample_of(i % 8 == 0 ? bright : i % 8 == 1 ? -bright : 1));
    const Film::Pixel pixel = film.pixel(0, 0);
    EXPECT_TRUE(is_finite(pixel.variance) && is_finite(pixel.split_difference)) << bright;
    EXPECT_GT(pixel.variance.x, 0) << bright;
    EXPECT_TRUE(std::isfinite(pixel.beauty.r)) << bright;
    EXPECT_TRUE(std::isfinite(film.estimate(0).error)) << bright;
  }
}

TEST(Film, HalvesAreEveryOtherFourSamples) {
  Film film(1, 1, box());
  // Means 2.5 of samples 0-3, 6.5 of 4-7, 10.5 of 8-11, 13.5 of the two after them.
  for (int i = 1; i <= 8; ++i) film.add(0, 0, sample_of(float(i)));
  EXPECT_TRUE(film.has_split_samples());
  EXPECT_FLOAT_EQ(film.pixel(0, 0).split_difference.x, (2.5f - 6.5f) / 2);
  for (int i = 9; i <= 14; ++i) film.add(0, 0, sample_of(float(i)));
  EXPECT_NEAR(film.pixel(0, 0).split_difference.x, (6.5f - (4 * 6.5f + 2 * 13.5f) / 6) / 2, 1e-5f);
}

TEST(Film, DoublingsAreChangesOfTheMean) {
  Film film(1, 1, box());
  // The means of the first 4, 8 and 16 of 1, 2, 3... are 2.5, 4.5 and 8.5.
  for (int i = 1; i <= 16; ++i) film.add(0, 0, sample_of(float(i)));
  EXPECT_FLOAT_EQ(film.estimate(0).doubling, 4);
  EXPECT_FLOAT_EQ(film.estimate(0).doubling_before, 2);
  for (int i = 17; i <= 24; ++i) film.add(0, 0, sample_of(float(i)));
  EXPECT_FLOAT_EQ(film.estimate(0).doubling, 4 * std::sqrt(16 / 24.f));
}

TEST(Film, HalvesOfFewSamplesAreNotThere) {
  Film film(2, 1, box());
  for (int i = 0; i < 8; ++i) film.add(0, 0, sample_of(1));
  for (int i = 0; i < 7; ++i) film.add(1, 0, sample_of(1));
  EXPECT_FALSE(film.has_split_samples());
  film.add(1, 0, sample_of(1));
  EXPECT_TRUE(film.has_split_samples());
}

TEST(Film, CleanColoursAreShownWithTheEdgesOfTheirPixel) {
  const auto root = [](int, int, const Rgb& c) {
    return Rgb(std::sqrt(c.x), std::sqrt(c.y), std::sqrt(c.z));
  };
  Film edge(1, 1, box(), root), noise(1, 1, box(), root);
  for (int i = 0; i < 256; ++i) {
    FilmSample s = sample_of(i % 2 ? 16.0f : 4.0f);
    s.sub_pixel = static_cast<std::uint8_t>(i % kSubPixels);
    edge.add(0, 0, s);
    s.sub_pixel = static_cast<std::uint8_t>(i / 2 % kSubPixels);
    noise.add(0, 0, s);
  }
  // Half the parts are 4 and half are 16 around 10, less what noise may have done of it.
  EXPECT_NEAR(edge.shown(0, 0, Rgb(10)).x, (2 + 4) / 2.0f, 0.02f);
  EXPECT_FLOAT_EQ(noise.shown(0, 0, Rgb(10)).x, std::sqrt(10.0f));
}

TEST(Film, ErrorIsUnknownBelowTwoSamples) {
  Film film(1, 1, box());
  EXPECT_EQ(film.estimate(0).error, std::numeric_limits<float>::infinity());
  film.add(0, 0, sample_of(3));
  EXPECT_EQ(film.estimate(0).error, std::numeric_limits<float>::infinity());
  EXPECT_EQ(film.estimate(0).mean, 3);
}

TEST(Film, DepthAndIrradianceAreMeansOverHits) {
  Film film(1, 1, box());
  FilmSample s;
  s.irradiance = 100;
  film.add(0, 0, s);
  s.depth = 2;
  s.irradiance = 10;
  film.add(0, 0, s);
  s.depth = 4;
  s.irradiance = 50;
  film.add(0, 0, s);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).depth, 3);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).irradiance, 30);
}

TEST(Film, ValuesThatAreNoNumbersDoNotSpoilThePixel) {
  Film film(1, 1, box());
  film.add(0, 0, sample_of(1));
  film.add(0, 0, sample_of(std::numeric_limits<float>::quiet_NaN()));
  film.add(0, 0, sample_of(std::numeric_limits<float>::infinity()));
  film.add(0, 0, sample_of(1));
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.r, 0.5f);
}

TEST(Film, NoiseIsEstimatedInDisplayValues) {
  const auto burnt = [](int, int, const Rgb& c) { return Rgb(std::min(c.x, 1.0f)); };
  Film film(2, 1, box(), burnt);
  for (const float v : {10.0f, 20.0f}) film.add(0, 0, sample_of(v));
  for (const float v : {0.1f, 0.3f}) film.add(1, 0, sample_of(v));
  EXPECT_EQ(film.estimate(0).error, 0);
  EXPECT_EQ(film.estimate(0).mean, 1);
  EXPECT_GT(film.pixel(0, 0).variance.x, 0);
  EXPECT_NEAR(film.estimate(1).error, 0.1, 1e-6);  // 0.2 / sqrt(2) / sqrt(2)
}

TEST(Film, AMapThatDoublesColoursDoublesTheirError) {
  // The standard error of the mean of .1 and .3 is .1.
  Film film(1, 1, box(), [](int, int, const Rgb& c) { return c * 2.0f; });
  for (const float v : {0.1f, 0.3f}) film.add(0, 0, sample_of(v));
  EXPECT_NEAR(film.estimate(0).mean, 0.4, 1e-6);
  EXPECT_NEAR(film.estimate(0).error, 0.2, 1e-6);
}

TEST(Film, MappedPartsAreFilteredAsThePictureIs) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter, [](int, int, const Rgb& c) { return c * 3.0f; });
  for (std::uint8_t i = 0; i < kSubPixels; ++i)
    for (const bool negative : {false, true}) {
      FilmSample s = sample_of(negative ? 1.0f : 4.0f);
      s.sub_pixel = i;
      s.negative = negative;
      film.add(0, 0, s);
    }
  const float filtered = 4 * filter.positive_share() - filter.negative_share();
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.r, filtered);
  EXPECT_NEAR(film.shown(0, 0).x, 3 * filtered, 1e-5f);
}

TEST(Film, MappingForDisplayDoesNotDarkenNoise) {
  // One path in sixteen finds light 16: the mean is 1, the root of the mean is 1, while the mean of
  // the roots would be .25.
  Film film(1, 1, box(), [](int, int, const Rgb& c) { return Rgb(std::sqrt(c.x)); });
  for (int i = 0; i < 4096; ++i) {
    FilmSample s = sample_of(i / kSubPixels % 16 == 0 ? 16.0f : 0.0f);
    s.sub_pixel = static_cast<std::uint8_t>(i % kSubPixels);
    film.add(0, 0, s);
  }
  EXPECT_NEAR(film.shown(0, 0).x, 1, 1e-3);
}

TEST(Film, ToneMappingKeepsEdgesOfBrightObjectsSmooth) {
  // Half of the pixel is black, half a hundred times white: mapped as a whole it would be white.
  const auto burnt = [](int, int, const Rgb& c) { return Rgb(std::min(c.x, 1.0f)); };
  Film film(1, 1, box(), burnt);
  for (int i = 0; i < 64; ++i) {
    FilmSample s = sample_of(i % 2 ? 100.0f : 0.0f);
    s.sub_pixel = static_cast<std::uint8_t>(i % kSubPixels);
    film.add(0, 0, s);
  }
  EXPECT_NEAR(film.shown(0, 0).x, 0.5f, 1e-6f);
}

// A bright half of the pixel behind a straight edge, without noise: the pixel has one of many
// levels. Mapped sample by sample it would be as bright as the half is large.
// acceptance: X8
TEST(Film, MappedEdgesHaveManyLevels) {
  const auto burnt = [](int, int, const Rgb& c) { return Rgb(std::min(c.x, 1.0f)); };
  for (const float degrees : {0.0f, 90.0f, 30.0f, 45.0f}) {
    const float a = degrees * kPi / 180;
    const Vec2 across(std::cos(a), std::sin(a));
    const float reach = std::abs(across.x) + std::abs(across.y);
    std::set<int> levels;
    for (int step = 0; step <= 64; ++step) {
      const float edge = (static_cast<float>(step) / 64 - .5f) * reach;
      Film film(1, 1, box(), burnt);
      float lit = 0;
      constexpr int kSide = 32;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2 place((static_cast<float>(i % kSide) + .5f) / kSide,
                         (static_cast<float>(i / kSide) + .5f) / kSide);
        const bool bright = (place - Vec2(.5f)).dot(across) < edge;
        FilmSample s = sample_of(bright ? 1000.0f : 0.0f);
        s.sub_pixel = sub_pixel_of(place);
        film.add(0, 0, s);
        lit += bright / static_cast<float>(kSide * kSide);
      }
      const float shown = film.shown(0, 0).x;
      EXPECT_GE(shown, lit - 1e-3f) << degrees << ", parts that the edge cuts are lit";
      EXPECT_LE(shown, lit + .5f) << degrees;
      levels.insert(static_cast<int>(std::lround(shown * 100)));
    }
    EXPECT_GT(levels.size(), 8u) << degrees;
  }
}

// Samples that are far too bright are noise, which denoising takes away: no edge, and no dark dot.
TEST(Film, BrightSamplesAreNoEdgesOfDenoisedPixels) {
  const auto curve = [](int, int, const Rgb& c) { return Rgb(c.x / (1 + c.x)); };
  for (const std::uint32_t samples : {64u, 256u})
    for (const std::uint32_t bright : {1u, 2u, 4u})
      for (std::uint32_t seed = 0; seed < 50; ++seed) {
        Film film(1, 1, box(), curve);
        for (std::uint32_t i = 0; i < samples; ++i) {
          sampling::Sampler sampler(3, static_cast<int>(seed), i);
          FilmSample s = sample_of(i < bright ? 500.0f : 1.0f);
          s.sub_pixel = sub_pixel_of(sampler.next_2d());
          film.add(0, 0, s);
        }
        EXPECT_NEAR(film.shown(0, 0, Rgb(1)).x, .5f, .01f) << samples << ' ' << bright;
      }
  // A real edge keeps its levels.
  Film edge(1, 1, box(), curve);
  for (std::uint32_t i = 0; i < 256; ++i) {
    sampling::Sampler sampler(3, 3, i);
    const Vec2 place = sampler.next_2d();
    FilmSample s = sample_of(place.x < .5f ? 100.0f : 0.0f);
    s.sub_pixel = sub_pixel_of(place);
    edge.add(0, 0, s);
  }
  // Parts that the edge cuts are bright; the pixel as one colour would show .98.
  EXPECT_GT(edge.shown(0, 0, Rgb(50)).x, .49f);
  EXPECT_LT(edge.shown(0, 0, Rgb(50)).x, .7f);
}

TEST(Film, LinearMapsAreTheSameBeforeAndAfterTheMean) {
  Film film(1, 1, box(), [](int, int, const Rgb& c) { return c * 3.0f; });
  for (std::uint32_t i = 0; i < 37; ++i) {
    sampling::Sampler sampler(0, 0, i);
    FilmSample s = sample_of(sampler.next_1d());
    s.sub_pixel = static_cast<std::uint8_t>(kSubPixels * sampler.next_1d());
    film.add(0, 0, s);
  }
  EXPECT_NEAR(film.shown(0, 0).x, 3 * film.pixel(0, 0).beauty.r, 1e-5f);
}

TEST(Film, NegativeLobesSubtract) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter);
  film.add(0, 0, sample_of(0));
  FilmSample ring = sample_of(1);
  ring.negative = true;
  film.add(0, 0, ring);
  EXPECT_FLOAT_EQ(film.pixel(0, 0).beauty.r, -filter.negative_share());
  EXPECT_EQ(film.samples(0, 0), 2u);
}

TEST(Film, ClipVariantsNeverGoBelowBlack) {
  Film film(1, 1, mitchell(true));
  film.add(0, 0, sample_of(0));
  FilmSample ring = sample_of(1);
  ring.negative = true;
  film.add(0, 0, ring);
  EXPECT_EQ(film.pixel(0, 0).beauty.r, 0);
}

TEST(Film, FiltersWithNegativeLobesPreserveConstants) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter);
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

/// A sample whose light came through those parts.
struct PartedSample {
  PathRecord record{RecordRequest{.aovs = true}};
  AovValues& parts = *record.aovs;
  FilmSample sample;

  PartedSample(float diffuse, float reflection, bool negative) {
    parts[Aov::Diffuse] = Rgb(diffuse, diffuse / 2, 0);
    parts[Aov::Reflection] = Rgb(reflection);
    parts.level_of(Aov::Diffuse) = Rgb(.5f);
    parts.level_of(Aov::Reflection) = Rgb(.25f);
    parts.occlusion = Rgb(.75f);
    parts.opacity = .5f;
    sample.beauty = parts[Aov::Diffuse] + parts[Aov::Reflection];
    sample.negative = negative;
    sample.record = &record;
  }
};

Rgb sum_of_results(const AovValues& o) {
  Rgb sum(0);
  for (const Rgb& c : o.result) sum += c;
  return sum;
}

TEST(Film, AovsAreMeansOfAllSamples) {
  Film film(1, 1, box(), {}, {.aovs = true});
  PartedSample a(1, 4, false), b(3, 0, false);
  b.parts.level_of(Aov::Diffuse) = Rgb(.1f);
  film.add(0, 0, a.sample);
  film.add(0, 0, b.sample);
  film.add(0, 0, {});
  film.add(0, 0, {});
  AovValues mean = film.outputs(0, 0);
  EXPECT_FLOAT_EQ(mean[Aov::Diffuse].x, 1);
  EXPECT_FLOAT_EQ(mean[Aov::Diffuse].y, .5f);
  EXPECT_FLOAT_EQ(mean[Aov::Reflection].x, 1);
  EXPECT_FLOAT_EQ(mean.level_of(Aov::Diffuse).x, .15f);
  // Samples without parts: nothing is occluded or cut out there.
  EXPECT_FLOAT_EQ(mean.occlusion.x, .875f);
  EXPECT_FLOAT_EQ(mean.opacity, .75f);
}

TEST(Film, AovsThatAreNoNumbersAreBlack) {
  Film film(1, 1, box(), {}, {.aovs = true});
  PartedSample sample(1, 1, false);
  AovValues& bad = sample.parts;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bad[Aov::Specular] = Rgb(1, nan, 1);
  bad.level_of(Aov::Specular) = Rgb(std::numeric_limits<float>::infinity());
  bad.opacity = nan;
  film.add(0, 0, sample.sample);
  AovValues mean = film.outputs(0, 0);
  EXPECT_EQ(mean[Aov::Specular], Rgb(0));
  EXPECT_EQ(mean[Aov::Reflection], Rgb(1)) << "the others are stored";
  EXPECT_EQ(mean.level_of(Aov::Specular), Rgb(0));
  EXPECT_EQ(mean.opacity, 0);
}

TEST(Film, StoresOutputsOnlyIfRequested) {
  EXPECT_FALSE(Film(1, 1, box()).keeps_outputs());
  Film film(2, 1, box(), {}, {.aovs = true});
  EXPECT_TRUE(film.keeps_outputs());
  PartedSample s(1, 2, false);
  film.add(1, 0, s.sample);
  EXPECT_EQ(sum_of_results(film.outputs(0, 0)), Rgb(0));
  EXPECT_EQ(film.outputs(1, 0)[Aov::Reflection], Rgb(2));
  EXPECT_EQ(film.outputs(1, 0).opacity, .5f);
}

TEST(Film, NonFiniteSamplesAddNoOutputs) {
  Film film(1, 1, box(), {}, {.aovs = true});
  PartedSample s(1, 2, false);
  s.sample.beauty.x = std::numeric_limits<float>::quiet_NaN();
  film.add(0, 0, s.sample);
  EXPECT_EQ(sum_of_results(film.outputs(0, 0)), Rgb(0));
  EXPECT_EQ(film.pixel(0, 0).beauty.g, 0);
}

// acceptance: U3
TEST(Film, OutputsAreFilteredAsThePictureIs) {
  const FilterSampler filter = mitchell(false);
  Film film(1, 1, filter, {}, {.aovs = true});
  PartedSample positive(1, 4, false), negative(3, 2, true);
  film.add(0, 0, positive.sample);
  film.add(0, 0, negative.sample);
  AovValues o = film.outputs(0, 0);
  const float p = filter.positive_share(), m = filter.negative_share();
  EXPECT_FLOAT_EQ(o[Aov::Diffuse].x, p * 1 - m * 3);
  EXPECT_FLOAT_EQ(o[Aov::Reflection].x, p * 4 - m * 2);
  EXPECT_FLOAT_EQ(o.level_of(Aov::Diffuse).x, .5f) << "what is alike everywhere stays";
  EXPECT_FLOAT_EQ(o.opacity, .5f);
  EXPECT_FLOAT_EQ(o.occlusion.x, .75f);
  const Rgba beauty = film.pixel(0, 0).beauty;
  EXPECT_FLOAT_EQ(sum_of_results(o).x, beauty.r);
  EXPECT_FLOAT_EQ(sum_of_results(o).y, beauty.g);
}

// acceptance: U3
TEST(Film, ClippedPicturesAreTheSumOfTheirOutputsToo) {
  Film film(1, 1, mitchell(true), {}, {.aovs = true});
  PartedSample positive(0, 1, false), negative(100, 1, true);
  film.add(0, 0, positive.sample);
  film.add(0, 0, negative.sample);
  const Rgba beauty = film.pixel(0, 0).beauty;
  EXPECT_EQ(beauty.r, 0);
  EXPECT_GT(beauty.b, 0) << "blue is not clipped";
  const Rgb sum = sum_of_results(film.outputs(0, 0));
  EXPECT_NEAR(sum.x, 0, 1e-5f);
  EXPECT_NEAR(sum.z, beauty.b, 1e-6f);
}

TEST(Film, SamplesOfOneSignSuffice) {
  for (const bool negative : {false, true}) {
    Film film(1, 1, mitchell(false), {}, {.aovs = true});
    PartedSample s(1, 2, negative);
    film.add(0, 0, s.sample);
    EXPECT_FLOAT_EQ(film.outputs(0, 0)[Aov::Reflection].x, 2) << negative;
    EXPECT_FLOAT_EQ(film.outputs(0, 0).opacity, .5f) << negative;
  }
}

TEST(Film, UserBuffersAreMeansOrFirstSamples) {
  for (const bool negative : {false, true}) {
    Film film(1, 1, mitchell(false), {},
              {.user_buffers = {PlaneRule::Mean, PlaneRule::FirstSample, PlaneRule::Mean}});
    EXPECT_EQ(film.user_buffers(), 3u);
    // The first sample may be one of either kind.
    for (const float value : {1.0f, 2.0f, 6.0f}) {
      Rgba values[] = {Rgba(value, 2 * value, 0, 1), Rgba(value), Rgba(0)};
      const PathRecord record(RecordRequest{}, values);
      FilmSample s = sample_of(1);
      s.negative = negative;
      s.record = &record;
      film.add(0, 0, s);
    }
    EXPECT_EQ(film.user_buffer(0, 0, 0), Rgba(3, 6, 0, 1));
    EXPECT_EQ(film.user_buffer(0, 0, 1), Rgba(1));
    EXPECT_TRUE(film.is_written(0));
    EXPECT_FALSE(film.is_written(2));
    film.clear();
    EXPECT_FALSE(film.is_written(0));
  }
}

/// Share of 95 % intervals of the mean that hold the truth.
double coverage(int samples, bool negative_lobes) {
  const FilterSampler filter = negative_lobes ? mitchell(false) : box();
  constexpr int kSide = 100;
  Film film(kSide, kSide, filter);
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

}  // namespace film_test
}  // namespace oriel
