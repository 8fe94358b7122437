// SPDX-License-Identifier: Apache-2.0
#include "image/false_color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "color/luminance.h"
#include "color/srgb.h"
#include "image/glyphs.h"

namespace oriel {
namespace false_color_test {

/// CIE 1976 lightness in 0...1, for colours above the linear segment near black.
float lightness(const Rgb& display) {
  const Rgb linear(srgb_decode(display));
  return 1.16f * std::cbrt(luminance(linear)) - .16f;
}

Rgb pixel(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return Rgb(p[0], p[1], p[2]);
}

TEST(FalseColor, LightnessRisesEvenly) {
  const float first = lightness(viridis(0)), last = lightness(viridis(1));
  EXPECT_NEAR(first, .15f, .02f);
  EXPECT_NEAR(last, .91f, .02f);
  for (float t = 0; t <= 1; t += 1 / 64.0f)
    EXPECT_NEAR(lightness(viridis(t)), first + (last - first) * t, .02f) << t;
  // Two colours of the published table.
  EXPECT_NEAR(viridis(.2f).z, 0x87 / 255.0f, 1e-5f);
  EXPECT_NEAR(viridis(2).x, 0xfd / 255.0f, 1e-5f);
}

TEST(FalseColor, ScalesAreRoundAndShowNearlyAll) {
  Image values(100, 10, 1);
  for (std::size_t i = 0; i < values.pixels.size(); ++i)
    values.pixels[i] = static_cast<float>(i) * .43f;
  values.pixels[0] = 1e9f;  // an outlier
  values.pixels[1] = std::numeric_limits<float>::quiet_NaN();
  const ValueScale linear = scale_of(values, false);
  EXPECT_EQ(linear.low, 0);
  EXPECT_EQ(linear.high, 500);
  const ValueScale logarithmic = scale_of(values, true);
  EXPECT_EQ(logarithmic.high, 500);
  EXPECT_EQ(logarithmic.low, 2);
  EXPECT_NEAR(logarithmic.position(std::sqrt(1000.0f)), .5f, 1e-6f);
  const ValueScale nothing = scale_of(Image(4, 4, 1), true);
  EXPECT_LT(nothing.low, nothing.high);
}

TEST(FalseColor, TicksAreRoundAndWithinTheScale) {
  EXPECT_EQ(scale_ticks({0, 500}), (std::vector<float>{0, 100, 200, 300, 400, 500}));
  EXPECT_EQ(scale_ticks({1, 100, true}), (std::vector<float>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(scale_ticks({1, 1e5f, true}), (std::vector<float>{1, 10, 100, 1000, 1e4f, 1e5f}));
  for (const ValueScale s : {ValueScale{0, 1}, ValueScale{3, 17}, ValueScale{.02f, .9f, true},
                             ValueScale{7, 13, true}, ValueScale{1e-3f, 1e7f, true}}) {
    const auto ticks = scale_ticks(s);
    EXPECT_GE(ticks.size(), 4u);
    EXPECT_LE(ticks.size(), 11u);
    EXPECT_GE(ticks.front(), s.low * .99f);
    EXPECT_LE(ticks.back(), s.high * 1.01f);
    EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
  }
}

TEST(FalseColor, NumbersAreShort) {
  EXPECT_EQ(tick_text(.5f), "0.5");
  EXPECT_EQ(tick_text(1500), "1500");
  EXPECT_EQ(tick_text(12000), "12k");
  EXPECT_EQ(tick_text(2.5e6f), "2.5M");
}

TEST(FalseColor, ValuesBecomeColoursWithALegendBesideThem) {
  Image values(64, 80, 1);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 64; ++x) *values.at(x, y) = static_cast<float>(x) * 10;
  const Image picture = false_color(values, {.scale = {0, 640}, .unit = "lx"});
  EXPECT_EQ(picture.height, 80);
  EXPECT_GT(picture.width, 64 + 20);
  EXPECT_EQ(pixel(picture, 0, 5), Rgb(0));  // no hit
  EXPECT_EQ(pixel(picture, 32, 5), viridis(.5f));
  // The bar shows the low end of the scale at the bottom and the high end at the top.
  const int bar = 64 + 6;
  EXPECT_EQ(pixel(picture, bar, 80 - 4 - 3), viridis(0));
  float before = 2;
  for (int y = 30; y < 70; ++y) {
    const float now = lightness(pixel(picture, bar, y));
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(FalseColor, IsolinesRunWhereValuesPassATick) {
  Image values(100, 60, 1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) *values.at(x, y) = static_cast<float>(x) + .5f;
  const Image picture = false_color(values, {.scale = {0, 100}, .isolines = true});
  for (int x = 0; x < 99; ++x) EXPECT_EQ(pixel(picture, x, 9) == Rgb(0), x % 20 == 19) << x;
}

TEST(Glyphs, AllCharactersOfLegendsExist) {
  for (const char c : std::string_view("0123456789.-+/lxcdmkMe")) EXPECT_TRUE(has_glyph(c)) << c;
  EXPECT_FALSE(has_glyph('?'));
  Image image(20, 9, 3);
  draw_text(image, 1, 1, "1", 1, Rgb(1, .5f, 0));
  EXPECT_EQ(pixel(image, 3, 1), Rgb(1, .5f, 0));
  EXPECT_EQ(pixel(image, 1, 1), Rgb(0));
  draw_text(image, 16, 5, "888", 3, Rgb(1));  // extends beyond the edges
  EXPECT_EQ(text_width("12", 2), 22);
}

}  // namespace false_color_test
}  // namespace oriel
