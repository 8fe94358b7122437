// SPDX-License-Identifier: Apache-2.0
// The denoiser on pictures with known ground truth.
#include "denoise/denoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/parallel.h"
#include "image/compare.h"

namespace oriel {
namespace denoise_test {

/// A synthetic render with its ground truth.
struct Render {
  Image truth, color, half, variance, albedo, normal, depth;
  DenoiseInput input() const { return {&color, &half, &variance, &albedo, &normal, &depth}; }
};

struct Point {
  std::array<float, 3> color, albedo, normal;
  float depth;
};
using Scene = std::function<Point(int x, int y)>;

/// Draws `samples` per pixel from an exponential distribution with the true mean: the standard
/// deviation equals the mean and the tail is long, like light that is found by chance.
Render render(int width, int height, int samples, const Scene& scene) {
  Render r;
  r.truth = r.color = r.half = r.variance = r.albedo = r.normal = Image(width, height, 3);
  r.depth = Image(width, height, 1);
  std::mt19937 random(1);
  std::exponential_distribution<float> light(1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Point p = scene(x, y);
      float mean[2] = {0, 0}, square = 0;
      for (int s = 0; s < samples; ++s) {
        const float v = light(random);
        mean[s % 2] += 2 * v / float(samples);
        square += v * v / float(samples);
      }
      const float whole = samples > 0 ? (mean[0] + mean[1]) / 2 : 1;
      const float half = (mean[0] - mean[1]) / 2;
      const float variance = samples > 0 ? (square - whole * whole) / float(samples - 1) : 0;
      for (int c = 0; c < 3; ++c) {
        r.truth.at(x, y)[c] = p.color[c];
        r.color.at(x, y)[c] = whole * p.color[c];
        r.half.at(x, y)[c] = half * p.color[c];
        r.variance.at(x, y)[c] = variance * p.color[c] * p.color[c];
        r.albedo.at(x, y)[c] = p.albedo[c];
        r.normal.at(x, y)[c] = p.normal[c];
      }
      *r.depth.at(x, y) = p.depth;
    }
  return r;
}

/// A wall with a checker texture and a floor, with smooth illumination.
Point room(int x, int y) {
  const bool floor = y > 60;
  const float light = 2 + std::sin(0.05f * float(x)) + 0.01f * float(y);
  const float texture = floor ? 0.4f : ((x / 12 + y / 12) % 2 ? 0.8f : 0.25f);
  Point p;
  p.albedo = {texture, 0.9f * texture, 0.7f * texture};
  for (int c = 0; c < 3; ++c) p.color[c] = light * p.albedo[c];
  p.normal = floor ? std::array<float, 3>{0, 0, 1} : std::array<float, 3>{0, -1, 0};
  p.depth = floor ? 4 - 0.02f * float(y - 60) : 4;
  return p;
}

double mean_of(const Image& image) {
  double sum = 0;  // double: a sum over the picture
  for (const float v : image.pixels) sum += v;
  return sum / double(image.pixels.size());
}

/// Mean of a channel over a rectangle.
double mean_of(const Image& image, int x0, int y0, int x1, int y1, int channel) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += image.at(x, y)[channel];
  return sum / ((x1 - x0) * (y1 - y0));
}

TEST(Denoise, ErrorFallsAtLeastFivefold) {
  for (const int samples : {16, 64}) {
    const Render r = render(128, 96, samples, room);
    const Image out = denoise(r.input());
    const double before = compare(r.color, r.truth).relative_mse;
    const double after = compare(out, r.truth).relative_mse;
    EXPECT_LT(after * 5, before) << samples << " samples";
    RecordProperty("gain_" + std::to_string(samples), std::to_string(before / after));
  }
}

TEST(Denoise, WallsHaveNoStains) {
  // The best that one window of 15 x 15 pixels can do is its mean, whose noise is a 15th.
  constexpr int kSamples = 16, kWindow = 15;
  constexpr double kNoise = 1.0 / 4;  // of a pixel, relative
  const Render r = render(256, 192, kSamples, [](int x, int y) {
    const float light = 2 + 0.002f * float(x) + 0.003f * float(y);
    return Point{{light, light, light}, {1, 1, 1}, {0, -1, 0}, 4};
  });
  const Image whole = denoise(r.input());
  DenoiseInput alone = r.input();
  alone.half_difference = nullptr;
  for (const Image& out : {whole, denoise(alone)})
    EXPECT_LT(std::sqrt(compare(out, r.truth).relative_mse), 0.9 * kNoise / kWindow);
}

TEST(Denoise, VarianceAloneStillLowersTheError) {
  const Render r = render(128, 96, 32, room);
  DenoiseInput input = r.input();
  input.half_difference = nullptr;
  EXPECT_LT(compare(denoise(input), r.truth).relative_mse * 5,
            compare(r.color, r.truth).relative_mse);
  input = r.input();
  input.variance = nullptr;
  EXPECT_LT(compare(denoise(input), r.truth).relative_mse * 5,
            compare(r.color, r.truth).relative_mse);
}

TEST(Denoise, NoFeaturesStillLowerTheError) {
  const Render r = render(128, 96, 32, room);
  EXPECT_LT(
      compare(denoise({.color = &r.color, .half_difference = &r.half}), r.truth).relative_mse * 3,
      compare(r.color, r.truth).relative_mse);
}

TEST(Denoise, MeanStays) {
  for (const int samples : {4, 16, 64}) {
    const Render r = render(128, 96, samples, room);
    EXPECT_NEAR(mean_of(denoise(r.input())) / mean_of(r.color), 1, 1e-4) << samples;
    // Without the other half, and without the sample variance.
    DenoiseInput input = r.input();
    input.half_difference = nullptr;
    EXPECT_NEAR(mean_of(denoise(input)) / mean_of(r.color), 1, 1e-4) << samples;
    input = r.input();
    input.variance = nullptr;
    EXPECT_NEAR(mean_of(denoise(input)) / mean_of(r.color), 1, 1e-4) << samples;
  }
}

TEST(Denoise, CleanRegionsGetNoLightOfNoisyOnes) {
  // The left third is a lamp without noise.
  Render r = render(128, 96, 16, room);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c) {
        r.color.at(x, y)[c] = 50;
        r.half.at(x, y)[c] = r.variance.at(x, y)[c] = 0;
        r.normal.at(x, y)[c] = 0;
      }
  const Image out = denoise(r.input());
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 28; ++x) ASSERT_NEAR(out.at(x, y)[0], 50, 5e-3) << x << ' ' << y;
  EXPECT_NEAR(mean_of(out, 40, 0, 128, 96, 1) / mean_of(r.color, 40, 0, 128, 96, 1), 1, 2e-3);
}

TEST(Denoise, PartsSumToThePictureAndKeepTheirEdges) {
  // A lamp that lights the left half and one that lights everything, with a firefly of the second.
  const auto left = [](int x, int y) {
    Point p = room(x, y);
    for (int c = 0; c < 3; ++c) p.color[c] *= x < 48 ? 1.5f : 0;
    return p;
  };
  Render all = render(96, 96, 32, [&](int x, int y) {
    Point p = room(x, y);
    for (int c = 0; c < 3; ++c) p.color[c] *= x < 48 ? 2.5f : 1;
    return p;
  });
  Render one = render(96, 96, 32, left), two = render(96, 96, 32, room);
  for (int c = 0; c < 3; ++c) {
    for (Image* image : {&all.color, &all.half, &two.color}) image->at(70, 30)[c] += 100;
    all.variance.at(70, 30)[c] += 100 * 100;
  }
  DenoiseInput input = all.input();
  input.parts = {&one.color, &two.color};
  const DenoisedPicture out = denoise_with_parts(input);
  EXPECT_EQ(out.color.pixels, denoise(all.input()).pixels);
  ASSERT_EQ(out.parts.size(), 2u);
  for (std::size_t i = 0; i < out.color.pixels.size(); ++i)
    ASSERT_NEAR(out.parts[0].pixels[i] + out.parts[1].pixels[i], out.color.pixels[i],
                1e-5f * out.color.pixels[i]);
  for (const auto& [part, noisy] :
       {std::pair{&out.parts[0], &one}, std::pair{&out.parts[1], &two}}) {
    EXPECT_LT(compare(*part, noisy->truth).rmse * 2, compare(noisy->color, noisy->truth).rmse);
    EXPECT_NEAR(mean_of(*part) / mean_of(noisy->color), 1, 0.01);
  }
  EXPECT_LT(mean_of(out.parts[0], 60, 0, 96, 96, 0), 0.01) << "no light of one lamp in the other";
}

TEST(Denoise, EdgesOfFeaturesKeepTheirStep) {
  struct Case {
    const char* name;
    std::array<float, 3> albedo, normal;
    float depth, light;
  };
  const std::array<float, 3> grey{0.5f, 0.5f, 0.5f}, up{0, 0, 1};
  constexpr int kRows = 512;
  for (const Case& edge : {Case{"albedo", {0.8f, 0.8f, 0.8f}, up, 3, 2},
                           Case{"normal", grey, {1, 0, 0}, 3, 3}, Case{"depth", grey, up, 5, 3}}) {
    const auto scene = [&](int x, int) {
      Point p = {{}, grey, up, 3};
      float light = 2;
      if (x >= 16) p = {{}, edge.albedo, edge.normal, edge.depth}, light = edge.light;
      for (int c = 0; c < 3; ++c) p.color[c] = light * p.albedo[c];
      return p;
    };
    // Enough rows to reduce the noise of the step to a third of the tolerance.
    const Render r = render(32, kRows, 64, scene);
    const Image out = denoise(r.input());
    // The two columns next to the edge: a blurred edge would have a smaller step there.
    const auto step_of = [&](const Image& image) {
      return mean_of(image, 16, 0, 17, kRows, 0) - mean_of(image, 15, 0, 16, kRows, 0);
    };
    EXPECT_NEAR(step_of(out) / step_of(r.truth), 1, 0.02) << edge.name;
  }
}

TEST(Denoise, ConstantPicturesStayBitIdentical) {
  Render r = render(50, 37, 0, [](int, int) {
    return Point{{0.1f, 0.7f, 1234.5f}, {0.3f, 0.3f, 0.9f}, {0, 0, 1}, 2};
  });
  EXPECT_EQ(denoise(r.input()).pixels, r.color.pixels);
  // Also with a large noise estimate.
  std::fill(r.variance.pixels.begin(), r.variance.pixels.end(), 0.5f);
  EXPECT_EQ(denoise(r.input()).pixels, r.color.pixels);
  DenoiseInput alone = r.input();
  alone.half_difference = nullptr;
  EXPECT_EQ(denoise(alone).pixels, r.color.pixels);
}

TEST(Denoise, CleanPicturesStay) {
  const Render r = render(96, 96, 0, room);
  const Image out = denoise(r.input());
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    ASSERT_NEAR(out.pixels[i], r.truth.pixels[i], 1e-4f * r.truth.pixels[i]);
}

TEST(Denoise, BiasVanishesWithTheNoise) {
  double last = std::numeric_limits<double>::infinity();
  for (const int samples : {16, 256, 4096}) {
    const Render r = render(64, 80, samples, room);
    const double error = compare(denoise(r.input()), r.truth).relative_mse;
    EXPECT_LT(error, compare(r.color, r.truth).relative_mse) << samples;
    EXPECT_LT(error * 4, last) << samples;
    last = error;
  }
}

TEST(Denoise, FirefliesGo) {
  Render r = render(96, 96, 32, room);
  // One sample of 3000 in a pixel of 2, in one half of the samples.
  for (const auto& [x, y] : {std::pair{20, 20}, {48, 70}, {90, 5}, {0, 95}}) {
    for (int c = 0; c < 3; ++c) {
      r.color.at(x, y)[c] += 100;
      r.half.at(x, y)[c] += 100;
      r.variance.at(x, y)[c] += 100 * 100;
    }
  }
  const Image out = denoise(r.input());
  EXPECT_LT(compare(out, r.truth).max_abs, 1);
  // Their light is part of the mean that all samples together estimate.
  EXPECT_NEAR(mean_of(out) / mean_of(r.color), 1, 0.005);
}

TEST(Denoise, BrightHighlightsAreNoFireflies) {
  // The same brightness, but all samples have it.
  Render r = render(96, 96, 32, room);
  for (int c = 0; c < 3; ++c) {
    r.color.at(48, 70)[c] = 100;
    r.half.at(48, 70)[c] = 0.5f;
    r.variance.at(48, 70)[c] = 0.3f;
  }
  EXPECT_NEAR(denoise(r.input()).at(48, 70)[1], 100, 2);
}

TEST(Denoise, HighlightsOfFewSamplesStayIfBothHalvesHaveThem) {
  // A glint in 4 of 8 samples, two in each half: its error is .38 of its value.
  Render r = render(96, 96, 8, room);
  for (int c = 0; c < 3; ++c) {
    r.color.at(48, 70)[c] = 100;
    r.half.at(48, 70)[c] = 1;
    r.variance.at(48, 70)[c] = 38 * 38;
  }
  EXPECT_GT(spread_outliers(r.input()).at(48, 70)[1], 98);
}

TEST(Denoise, ResultScalesWithTheLight) {
  const Render r = render(64, 80, 32, room);
  const Image plain = denoise(r.input());
  for (const float scale : {0x1p-30f, 0x1p20f}) {
    Render scaled = r;
    for (Image* image : {&scaled.color, &scaled.half})
      for (float& v : image->pixels) v *= scale;
    for (float& v : scaled.variance.pixels) v *= scale * scale;
    const Image out = denoise(scaled.input());
    for (std::size_t i = 0; i < out.pixels.size(); ++i)
      ASSERT_NEAR(out.pixels[i] / scale, plain.pixels[i], 1e-3f * plain.pixels[i]);
  }
}

TEST(Denoise, EverythingThatComesOutIsFinite) {
  Render r = render(70, 80, 4, room);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  r.color.at(3, 4)[1] = nan;
  r.color.at(30, 4)[0] = infinity;
  r.half.at(8, 60)[2] = nan;
  r.variance.at(9, 9)[0] = infinity;
  r.albedo.at(40, 40)[0] = nan;
  r.normal.at(41, 50)[0] = infinity;
  *r.depth.at(11, 12) = nan;
  r.color.at(60, 70)[0] = 1e18f;
  r.color.at(60, 60)[0] = -3;
  std::fill_n(r.color.at(0, 40), 70 * 3 * 10, 0.0f);
  std::fill_n(r.variance.at(0, 40), 70 * 3 * 10, 0.0f);
  std::fill_n(r.half.at(0, 40), 70 * 3 * 10, 0.0f);
  for (const float v : denoise(r.input()).pixels) ASSERT_TRUE(std::isfinite(v));
}

TEST(Denoise, ThreadsDoNotMatter) {
  const Render r = render(70, 80, 16, room);
  Image one;
  {
    const ThreadLimit limit(1);
    one = denoise(r.input());
  }
  EXPECT_EQ(denoise(r.input()).pixels, one.pixels);
}

TEST(Denoise, AlphaAndTinyPicturesPass) {
  Image color(3, 2, 4, 0.5f);
  color.at(1, 1)[3] = 0.25f;
  const Image half(3, 2, 3, 0.1f);
  const Image out = denoise({.color = &color, .half_difference = &half});
  EXPECT_EQ(out.channels, 4);
  EXPECT_EQ(out.at(1, 1)[3], 0.25f);
}

TEST(Denoise, MissingAndMismatchedInputsAreTold) {
  const Image color(4, 4, 3), small(3, 4, 3);
  EXPECT_THROW(denoise({}), std::runtime_error);
  EXPECT_THROW(denoise({.color = &color}), std::runtime_error);
  EXPECT_THROW(denoise({.color = &color, .variance = &small}), std::runtime_error);
}

}  // namespace denoise_test
}  // namespace oriel
