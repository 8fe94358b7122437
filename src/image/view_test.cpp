// SPDX-License-Identifier: Apache-2.0
#include "image/view.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/expect_near.h"

namespace oriel {
namespace view_test {

using testing::expect_near;

TEST(View, DefaultClampsToTheUnitRange) {
  expect_near(view_color(Rgba(-1, 0.25f, 3, 2), {}), Rgba(0, 0.25f, 1, 1), 1e-6f);
}

TEST(View, GammaIsAnExponentOnColourAndNotOnAlpha) {
  ViewOptions options;
  options.gamma = 2;
  expect_near(view_color(Rgba(0.25f, 0.81f, 4, 0.25f), options), Rgba(0.5f, 0.9f, 1, 0.25f), 1e-6f);
}

TEST(View, ClipModesPreserveTheNamedQuantity) {
  const Rgba bright(0.8f, 0.5f, 0.1f, 0.4f);
  ViewOptions options;
  expect_near(view_color(bright, options), bright, 1e-6f);
  options.clip = ColorClip::KeepColor;
  expect_near(view_color(bright, options), Rgba(0.8f, 0.5f, 0.1f, 0.8f), 1e-6f);
  options.clip = ColorClip::KeepAlpha;
  expect_near(view_color(bright, options), Rgba(0.4f, 0.4f, 0.1f, 0.4f), 1e-6f);
}

TEST(View, PremultiplyOffDividesAndCouplesNothing) {
  ViewOptions options;
  options.premultiply = false;
  options.clip = ColorClip::KeepAlpha;
  expect_near(view_color(Rgba(0.1f, 0.2f, 0.3f, 0.4f), options), Rgba(0.25f, 0.5f, 0.75f, 0.4f),
              1e-6f);
  expect_near(view_color(Rgba(0.1f, 0.2f, 0.3f, 0), options), Rgba(0.1f, 0.2f, 0.3f, 0), 1e-6f);
}

TEST(View, DesaturateKeepsTheIntensityAndLeavesColoursInRangeAlone) {
  ViewOptions options;
  options.desaturate = true;
  const Rgb weight = options.luminance_weight;
  const Rgb orange(1.6f, 0.4f, 0.1f);
  const Rgba got = view_color(Rgba(orange.x, orange.y, orange.z, 1), options);
  EXPECT_NEAR(got.r, 1, 1e-6f);
  EXPECT_NEAR(weight.dot(rgb(got)), weight.dot(orange), 1e-6f);
  EXPECT_GT(got.b, 0.1f) << "it fades towards white";
  expect_near(view_color(Rgba(0.9f, 0.2f, 0, 1), options), Rgba(0.9f, 0.2f, 0, 1), 1e-6f);
  expect_near(view_color(Rgba(5, 3, 2, 1), options), Rgba(1, 1, 1, 1), 1e-6f);
  const Rgba negative = view_color(Rgba(-0.2f, 0.5f, 0.5f, 1), options);
  EXPECT_NEAR(negative.r, 0, 1e-6f);
  EXPECT_NEAR(weight.dot(rgb(negative)), weight.dot(Rgb(-0.2f, 0.5f, 0.5f)), 1e-6f);
}

TEST(View, NanBecomesOne) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const bool on : {false, true}) {
    ViewOptions options;
    options.desaturate = on;
    options.premultiply = !on;
    options.gamma = 2.2f;
    for (const Rgba& c : {Rgba(nan, inf, -inf, nan), Rgba(inf, inf, inf, 1e-30f)}) {
      const Rgba got = view_color(c, options);
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(got[i] >= 0 && got[i] <= 1) << i;
    }
  }
}

TEST(View, PixelsAreIndependentForAnyChannels) {
  ViewOptions options;
  options.gamma = 2;
  for (int channels = 1; channels <= 4; ++channels) {
    const Image out = view_image(Image(3, 2, channels, 0.25f), options);
    for (int c = 0; c < channels; ++c)
      EXPECT_NEAR(out.at(2, 1)[c], channels % 2 == 0 && c == channels - 1 ? 0.25f : 0.5f, 1e-6f);
  }
}

}  // namespace view_test
}  // namespace oriel
