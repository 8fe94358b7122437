// SPDX-License-Identifier: Apache-2.0
#include "image/recombine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "support/output_layers.h"

namespace oriel {
namespace recombine_test {

Image& image_of(std::vector<Layer>& layers, const std::string& name) {
  for (Layer& layer : layers)
    if (layer.name == name) return layer.image;
  throw std::runtime_error("no layer " + name);
}

void expect_all(const Image& image, float value) {
  for (const float v : image.pixels) ASSERT_FLOAT_EQ(v, value);
}

TEST(Recombine, BothFormsFollowTheirEquations) {
  auto layers = output_layers(3, 2);
  // Each term is a different power of two, so the sum shows which terms it contains.
  float result = 1;
  for (const char* name : {"diffuse_result", "indirect_result", "spec_result", "refl_result",
                           "refr_result", "tran_result", "add_result", "opacity_result", "other"}) {
    std::fill_n(image_of(layers, name).pixels.begin(), 18, result);
    result *= 2;
  }
  expect_all(recombine(layers).simple, 511);

  const auto set = [&](const std::string& name, float value) {
    for (float& v : image_of(layers, name).pixels) v = value;
  };
  set("diffuse_level", 0.5f), set("diffuse_raw", 3), set("indirect_post_ao", 1);
  set("spec_level", 2), set("spec_raw", 5);
  set("refl_level", 3), set("refl_raw", 7);
  set("refr_level", 4), set("refr_raw", 11);
  set("tran_level", 5), set("tran_raw", 13);
  set("opacity", 0.75f), set("opacity_raw", 16);
  set("add_result", 100), set("other", 1000);
  expect_all(recombine(layers).complex,
             0.5f * (3 + 1) + 10 + 21 + 44 + 65 + 100 + 0.25f * 16 + 1000);
}

TEST(Recombine, BothFormsReproduceTheImage) {
  const auto layers = output_layers(16, 9);
  const Recombination r = recombine(layers);
  const Image& beauty = find_layer(layers, "")->image;
  for (const Image* image : {&r.simple, &r.complex}) {
    const RebuiltDifference d = compare_rebuilt(*image, beauty, 1e-4f);
    EXPECT_LE(d.largest, 1e-6f);
    EXPECT_EQ(d.above, 0u);
  }
}

TEST(Recombine, DifferencesAreRelativeAboveTheFloor) {
  Image beauty(10, 10, 4, 1);
  beauty.at(0, 0)[0] = 0;
  Image rebuilt(10, 10, 3, 1);
  rebuilt.at(0, 0)[0] = 1e-6f;
  rebuilt.at(7, 2)[1] = 1.01f;
  const RebuiltDifference d = compare_rebuilt(rebuilt, beauty, 1e-4f);
  EXPECT_NEAR(d.largest, 0.01f, 1e-6);
  EXPECT_EQ(d.x, 7);
  EXPECT_EQ(d.y, 2);
  EXPECT_EQ(d.channel, 1);
  EXPECT_FLOAT_EQ(d.rebuilt, 1.01f);
  EXPECT_FLOAT_EQ(d.beauty, 1);
  // The mean excludes alpha: 299 ones among 300 values.
  EXPECT_NEAR(d.floor, kRecombineFloorShare * 299 / 300, 1e-9);
  EXPECT_NEAR(relative_difference(rebuilt, beauty).at(0, 0)[0], 1e-6f / d.floor, 1e-6);
  EXPECT_EQ(d.above, 2u);
}

TEST(Recombine, APixelWithSeveralBadChannelsCountsOnce) {
  const Image beauty(4, 4, 3, 1);
  Image rebuilt = beauty;
  for (int c = 0; c < 3; ++c) rebuilt.at(1, 3)[c] = 2;
  EXPECT_EQ(compare_rebuilt(rebuilt, beauty, 1e-4f).above, 1u);
  EXPECT_EQ(compare_rebuilt(rebuilt, beauty, 1).above, 0u);
}

TEST(Recombine, NanCountsAsInfiniteDifference) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image beauty(4, 4, 3, 1);
    Image rebuilt = beauty;
    rebuilt.at(3, 1)[2] = bad;
    beauty.at(3, 1)[2] = bad;  // also if both pictures have the same invalid value
    const RebuiltDifference d = compare_rebuilt(rebuilt, beauty, 1e30f);
    EXPECT_TRUE(std::isinf(d.largest));
    EXPECT_EQ(d.x, 3);
    EXPECT_EQ(d.y, 1);
    EXPECT_EQ(d.channel, 2);
    EXPECT_EQ(d.above, 1u);
    EXPECT_FLOAT_EQ(d.floor, kRecombineFloorShare);
  }
}

TEST(Recombine, BlackPicturesAgreeWithBlackAlone) {
  const Image black(4, 4, 3);
  EXPECT_EQ(compare_rebuilt(black, black, 0).above, 0u);
  EXPECT_EQ(compare_rebuilt(Image(4, 4, 3, 1e-20f), black, 1).above, 16u);
}

TEST(Recombine, UnusableLayersAreNamed) {
  auto layers = output_layers(4, 4);
  EXPECT_TRUE(unusable_outputs(layers).empty());
  std::erase_if(layers, [](const Layer& l) { return l.name == "diffuse_raw"; });
  image_of(layers, "spec_level") = Image(4, 4, 1);
  image_of(layers, "opacity") = Image(4, 4, 3);
  image_of(layers, "other") = Image(4, 5, 3);
  EXPECT_EQ(
      unusable_outputs(layers),
      (std::vector<std::string>{"diffuse_raw is missing", "spec_level has 1 channel instead of 3",
                                "other has 4 x 5 pixels, the picture 4 x 4 pixels",
                                "opacity has 3 channels instead of 1"}));
  EXPECT_THROW(recombine(layers), std::runtime_error);
  EXPECT_EQ(unusable_outputs({}).size(), 23u) << "the picture, 21 colours, opacity";
  EXPECT_EQ(unusable_outputs({}).front(), "the beauty layer (R, G, B) is missing");
}

}  // namespace recombine_test
}  // namespace oriel
