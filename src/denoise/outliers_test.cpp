// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "denoise/denoise.h"

namespace oriel {
namespace outliers_test {

constexpr int kSize = 96;

/// A grey gradient with a known error of each pixel.
struct Picture {
  Image color{kSize, kSize, 3}, variance{kSize, kSize, 3};
  Picture() {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) set(x, y, .5f + .005f * static_cast<float>(x), .02f);
  }
  void set(int x, int y, float value, float error) {
    for (int c = 0; c < 3; ++c) color.at(x, y)[c] = value, variance.at(x, y)[c] = error * error;
  }
  Image spread() const { return spread_outliers({.color = &color, .variance = &variance}); }
};

double sum(const Image& image) {
  double all = 0;
  for (const float v : image.pixels) all += v;
  return all;
}

TEST(Outliers, LoseTheirExcessToTheNeighbourhood) {
  for (const float value : {5.0f, 80.0f}) {
    Picture p;
    p.set(40, 50, value, value * .9f);
    const Image out = p.spread();
    EXPECT_LT(out.at(40, 50)[0], 1.3f) << value;
    EXPECT_NEAR(sum(out) / sum(p.color), 1, 1e-5) << "no light is lost";
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        if (x == 40 && y == 50) continue;
        ASSERT_LE(out.at(x, y)[1], 1.35f * p.color.at(x, y)[1]) << x << ' ' << y;
      }
  }
}

TEST(Outliers, AreNotPixelsThatAreBrightInTruth) {
  Picture p;
  p.set(40, 50, 80, 4);  // known to a twentieth
  EXPECT_EQ(p.spread().pixels, p.color.pixels);
}

/// Few samples made the light of a pixel, as many in each half of the samples.
TEST(Outliers, AreMadeByFewSamplesThatBothHalvesMayHave) {
  for (const int samples : {2, 4, 8, 16}) {
    Picture p;
    p.set(40, 50, 5, 5 / std::sqrt(static_cast<float>(samples)));
    const Image equal(kSize, kSize, 3);
    const Image out =
        spread_outliers({.color = &p.color, .half_difference = &equal, .variance = &p.variance});
    EXPECT_NEAR(sum(out) / sum(p.color), 1, 1e-5) << samples;
    if (samples < 5)
      EXPECT_LT(out.at(40, 50)[0], 1.3f) << samples;
    else
      EXPECT_EQ(out.pixels, p.color.pixels) << samples;
  }
}

TEST(Outliers, AreNotPartsOfBrightRegions) {
  Picture p;
  for (int y = 50; y < 54; ++y)
    for (int x = 40; x < 44; ++x) p.set(x, y, 80, 60);
  EXPECT_EQ(p.spread().pixels, p.color.pixels);
}

TEST(Outliers, KeepTheirColour) {
  Picture p;
  p.set(40, 50, 20, 18);
  p.color.at(40, 50)[0] = 0;  // cyan
  const Image out = p.spread();
  EXPECT_EQ(out.at(40, 50)[0], 0);
  EXPECT_EQ(out.at(43, 50)[0], p.color.at(43, 50)[0]) << "no red was there to spread";
  EXPECT_GT(out.at(43, 50)[1], p.color.at(43, 50)[1]);
}

TEST(Outliers, StayInBlackSurroundings) {
  Picture p;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) p.set(x, y, 0, 0);
  p.set(40, 50, 20, 18);
  EXPECT_NEAR(sum(p.spread()), sum(p.color), 1e-4);
}

}  // namespace outliers_test
}  // namespace oriel
