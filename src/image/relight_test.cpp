// SPDX-License-Identifier: Apache-2.0
#include "image/relight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "color/luminance.h"

namespace oriel {
namespace relight_test {

const std::vector<std::string> kRgb = {"R", "G", "B"};

std::vector<Layer> picture() {
  std::vector<Layer> layers = {{"", {"R", "G", "B", "A"}, Image(4, 2, 4, .5f)},
                               {"Z", {""}, Image(4, 2, 1, 7)},
                               {"variance", kRgb, Image(4, 2, 3, .01f)},
                               {"light_key", kRgb, Image(4, 2, 3, 2)},
                               {"light_rest", kRgb, Image(4, 2, 3, 1)}};
  return layers;
}

TEST(Relight, TheBeautyIsTheSumOfTheScaledGroups) {
  const auto out = relight(picture(), {{"key", Rgb(.5f, 1, 2)}});
  const Image& beauty = find_layer(out, "")->image;
  for (std::size_t i = 0; i < beauty.pixel_count(); ++i) {
    EXPECT_EQ(beauty.pixels[4 * i], 2);
    EXPECT_EQ(beauty.pixels[4 * i + 1], 3);
    EXPECT_EQ(beauty.pixels[4 * i + 2], 5);
    EXPECT_EQ(beauty.pixels[4 * i + 3], .5f) << "alpha stays";
  }
  EXPECT_EQ(find_layer(out, "light_key")->image.pixels[2], 4);
  EXPECT_EQ(find_layer(out, "light_rest")->image.pixels[2], 1);
  EXPECT_NE(find_layer(out, "Z"), nullptr);
  EXPECT_EQ(find_layer(out, "variance"), nullptr) << "of another picture";
  // Gains of the same group multiply, and the result can be relit again.
  const auto again = relight(out, {{"key", Rgb(2)}, {"key", Rgb(.5f)}});
  EXPECT_EQ(find_layer(again, "")->image.pixels, beauty.pixels);
}

TEST(Relight, LayersOfEarlierVersionsAreFound) {
  std::vector<Layer> layers = picture();
  layers[3].name = "light.key";
  const auto lights = light_layers(layers);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0], &layers[3]);
  EXPECT_EQ(lights[1], &layers[4]);
  EXPECT_EQ(light_layer_names(layers), (std::vector<std::string>{"key", "rest"}));
}

TEST(Relight, TintsKeepTheLuminance) {
  for (const float warmth : {-1.0f, 0.0f, .2f, 1.0f}) {
    const Rgb c = tinted(1.5f, warmth);
    EXPECT_NEAR(luminance(c), 1.5f, 1e-5f);
    EXPECT_NEAR(c.x / c.z, std::exp2(2 * warmth), 1e-4f);
  }
}

TEST(Relight, InvalidSettingsAreReportedWithTheGroups) {
  const auto message = [](const std::vector<Layer>& layers, const std::string& group) {
    try {
      relight(layers, {{group, Rgb(1)}});
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message(picture(), "kye").find("key, rest"), std::string::npos);
  auto layers = picture();
  layers[3].image = Image(3, 3, 3);
  EXPECT_NE(message(layers, "key").find("light_key"), std::string::npos);
  layers.resize(3);
  EXPECT_NE(message(layers, "key").find("--light-group"), std::string::npos);
  layers.erase(layers.begin());
  EXPECT_NE(message(layers, "key").find("missing"), std::string::npos);
}

}  // namespace relight_test
}  // namespace oriel
