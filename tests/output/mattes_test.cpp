// SPDX-License-Identifier: Apache-2.0
#include "render/mattes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "image/cryptomatte.h"
#include "output/layer_table.h"
#include "output/matte_layers.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace mattes_test {

using testing::PreparedScene;

/// Two squares side by side whose border cuts pixels, with two materials, before nothing; the left
/// one stands there twice.
std::string two_squares(const std::string& options = "") {
  const auto square = [](const std::string& name, double x0, double x1) {
    const std::string a = std::to_string(x0), b = std::to_string(x1);
    return "object \"" + name + "\" visible trace group " + a + " -1 -4 " + b + " -1 -4 " + b +
           " .83 -4 " + a +
           " .83 -4 v 0 v 1 v 2 v 3 p 0 1 2 3 end group "
           "end object\n";
  };
  return "options \"opt\" object space " + options +
         " end options\n"
         "camera \"cam\" focal 1 aperture 1 aspect 1 resolution 16 16 end camera\n"
         "instance \"cam_i\" \"cam\" end instance\n"
         "material \"red\" \"mib_illum_lambert\" ( ) end material\n"
         "material \"blue\" \"mib_illum_lambert\" ( ) end material\n" +
         square("plate", -1.5, .13) + square("card", .13, 1.2) +
         "instance \"left\" \"plate\" material [ \"red\" ] tag 7 end instance\n"
         "instance \"again\" \"plate\" material [ \"red\" ] transform "
         "1 0 0 0  0 1 0 0  0 0 1 0  0 -2.2 0 1 end instance\n"
         "instance \"right\" \"card\" material [ \"blue\" ] tag 9 end instance\n"
         "instgroup \"root\" \"cam_i\" \"left\" \"right\" \"again\" end instgroup\n"
         "render \"root\" \"cam_i\" \"opt\"\n";
}

struct Rendered {
  PreparedScene scene;
  std::unique_ptr<RenderSession> session;
  explicit Rendered(const std::string& text, std::uint32_t samples = 64) : scene(text) {
    SessionSettings settings;
    settings.budget.samples = samples;
    settings.mattes = matte_names(scene.scene, *scene.world, kMatteRanks);
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  /// Coverage of a name, from the layers of that type as a reader finds it.
  float coverage(const std::vector<Layer>& layers, const std::string& type, const std::string& name,
                 int x, int y) const {
    float sum = 0;
    for (const Layer& layer : layers)
      if (layer.name.starts_with(type))
        for (int c = 0; c < 4; c += 2)
          if (layer.image.at(x, y)[c] == cryptomatte_id(name)) sum += layer.image.at(x, y)[c + 1];
    return sum;
  }
};

TEST(Mattes, RanksOfAPixelSumToOne) {
  for (const char* filter : {"", "filter gauss 3 3", "filter mitchell 4 4"}) {
    const Rendered r(two_squares(filter));
    const std::vector<Layer> layers = cryptomatte_layers(*r.session);
    ASSERT_EQ(layers.size(), 9u) << "three types of six ranks";
    for (const char* type : {"CryptoObject", "CryptoMaterial", "CryptoAsset"})
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
          float sum = 0;
          for (const Layer& layer : layers)
            if (layer.name.starts_with(type))
              sum += layer.image.at(x, y)[1] + layer.image.at(x, y)[3];
          EXPECT_NEAR(sum, 1, 1e-5f) << type << filter << x << "," << y;
        }
  }
}

TEST(Mattes, AMatteIsTheObjectsShareOfThePicture) {
  // The border at x = .13, 4 away, is pixel 8 + 16 * .13 / 4 = 8.52: 52 % of pixel 8.
  const Rendered r(two_squares(), 1024);
  const std::vector<Layer> layers = cryptomatte_layers(*r.session);
  constexpr int kRow = 8;
  EXPECT_NEAR(r.coverage(layers, "CryptoObject", "left", 8, kRow), .52f, 5e-3f);
  EXPECT_NEAR(r.coverage(layers, "CryptoObject", "right", 8, kRow), .48f, 5e-3f);
  EXPECT_EQ(r.coverage(layers, "CryptoObject", "right", 7, kRow), 0);
  EXPECT_EQ(r.coverage(layers, "CryptoMaterial", "red", 7, kRow), 1);
  EXPECT_NEAR(r.coverage(layers, "CryptoMaterial", "blue", 8, kRow), .48f, 5e-3f);
}

TEST(Mattes, AMatteIsTheAlphaOfARenderOfThatObjectAlone) {
  const Rendered both(two_squares());
  const std::vector<Layer> layers = cryptomatte_layers(*both.session);
  std::string text = two_squares();
  text.replace(text.find("\"left\" \"right\" \"again\" end"), 22, "\"right\"");
  const Rendered alone(text);
  // The edge that both squares share is a silhouette of the one alone, with more places per sample.
  float matte = 0, alpha = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const float covered = both.coverage(layers, "CryptoObject", "right", x, y);
      const float visible = alone.session->film().pixel(x, y).beauty.a;
      EXPECT_NEAR(covered, visible, .04f) << x << "," << y;
      matte += covered, alpha += visible;
    }
  EXPECT_NEAR(matte / alpha, 1, .003f);
}

TEST(Mattes, AssetsGatherTheInstancesOfAnObject) {
  const Rendered r(two_squares());
  const std::vector<Layer> layers = cryptomatte_layers(*r.session);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_NEAR(r.coverage(layers, "CryptoAsset", "plate", x, y),
                  r.coverage(layers, "CryptoObject", "left", x, y) +
                      r.coverage(layers, "CryptoObject", "again", x, y),
                  1e-5f);
}

TEST(Mattes, ObjectNamesLackTheSuffixOfExporters) {
  const auto names_of = [](std::string text,
                           const std::vector<std::array<const char*, 2>>& renamed) {
    for (const auto& [from, to] : renamed)
      for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += 20)
        text.replace(at, std::string(from).size(), to);
    const PreparedScene s(text);
    std::vector<std::string> names = matte_names(s.scene, *s.world, 6).objects;
    std::sort(names.begin(), names.end());
    return names;
  };
  using Names = std::vector<std::string>;
  // "left" and "right" are pieces of one mesh; "again" is another instance of an object.
  EXPECT_EQ(names_of(two_squares(), {{"\"left\"", "\"chair_inst\""},
                                     {"\"right\"", "\"chair_inst_2\""},
                                     {"\"again\"", "\"copy_inst\""}}),
            (Names{"chair", "chair", "copy"}));
  // Two instances of one object stay distinct.
  EXPECT_EQ(names_of(two_squares(), {{"\"left\"", "\"plate_inst\""},
                                     {"\"again\"", "\"plate_inst_2\""},
                                     {"\"right\"", "\"card_instance\""}}),
            (Names{"card_instance", "plate_inst", "plate_inst_2"}));
}

TEST(Mattes, TransparentThingsCoverByTheirOpacity) {
  const std::string cut = "\"mia_material_x\" ( \"cutout_opacity\" .25 )";
  std::string text = two_squares();
  text.replace(text.find("\"mib_illum_lambert\" ( )"), 23, cut);
  const Rendered r(text, 4096);
  // Standard error .0068.
  EXPECT_NEAR(r.coverage(cryptomatte_layers(*r.session), "CryptoMaterial", "red", 4, 8), .25f,
              .027f);
}

TEST(Mattes, LabelsAndCoverageAreThoseOfTheLargestCoverage) {
  const Rendered r(two_squares(), 256);
  const Image labels = layer_image(*r.session, *find_layer_spec("tag")),
              coverage = layer_image(*r.session, *find_layer_spec("coverage"));
  EXPECT_EQ(*labels.at(7, 8), 7);
  EXPECT_EQ(*labels.at(10, 8), 9);
  EXPECT_EQ(*labels.at(12, 0), 0);
  EXPECT_EQ(*coverage.at(7, 8), 1);
  EXPECT_NEAR(*coverage.at(8, 8), .52f, .01f);
  EXPECT_EQ(*coverage.at(12, 0), 0);
}

TEST(Mattes, ManifestsListTheNames) {
  const Rendered r(two_squares(), 1);
  const auto m = cryptomatte_metadata(*r.session);
  EXPECT_EQ(m.size(), 12u);
  std::string all;
  for (const auto& [key, value] : m)
    if (key.ends_with("manifest")) all += value;
  for (const char* name : {"left", "right", "again", "red", "blue", "plate", "card"})
    EXPECT_NE(all.find("\"" + std::string(name) + "\":"), std::string::npos) << name << all;
}

}  // namespace mattes_test
}  // namespace oriel
