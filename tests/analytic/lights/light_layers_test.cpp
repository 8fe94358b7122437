// SPDX-License-Identifier: Apache-2.0
// Light groups as layers: they sum to the beauty, and each has the light of its group.
#include <algorithm>

#include "image/relight.h"
#include "output/output.h"
#include "prepare/testing/prepared_scene.h"
#include "support/probe.h"

namespace oriel::testing {
namespace light_layers_test {

constexpr int kSize = 12;

struct Room {
  std::string options = "trace depth 6 6 8 shadow segments caustic on finalgather accuracy 16";
  std::string method = "path";
  bool lamps = true, spot = true, sky = true, bulb = true, portal = true;
};

const std::string kFewPhotons = "globillum photons 4000 caustic photons 500";

/// A room with a portal window, a group of two point lights, a spot, an emissive mesh and a glass
/// box.
std::string text_of(const Room& r) {
  SceneText scene(r.options);
  scene.camera("focal 1 aperture 1.6 aspect 1 resolution 12 12")
      .lambert("grey", .6f)
      .material("glossy",
                "\"diffuse\" .3 .3 .3, \"reflectivity\" .5, \"refl_gloss\" .6, "
                "\"brdf_fresnel\" off, \"brdf_0_degree_refl\" .5")
      .material("glass",
                "\"diffuse_weight\" 0, \"reflectivity\" .2, \"transparency\" .9, "
                "\"refr_ior\" 1.4")
      .emitter("glow", r.bulb ? 6.0f : 0.0f);
  // No wall at x = 2.
  scene.polygon("glossy", {Vec3(-2, -1, -4), Vec3(-2, -1, 1), Vec3(2, -1, 1), Vec3(2, -1, -4)})
      .polygon("grey", {Vec3(-2, 1, -4), Vec3(2, 1, -4), Vec3(2, 1, 1), Vec3(-2, 1, 1)})
      .polygon("grey", {Vec3(-2, -1, -4), Vec3(2, -1, -4), Vec3(2, 1, -4), Vec3(-2, 1, -4)})
      .polygon("grey", {Vec3(-2, -1, 1), Vec3(-2, -1, -4), Vec3(-2, 1, -4), Vec3(-2, 1, 1)})
      .box("glass", Vec3(-.6f, -1, -2.6f), Vec3(.2f, 0, -2))
      .box("glow", Vec3(.6f, -.9f, -2.6f), Vec3(.8f, -.7f, -2.4f));
  if (r.sky) scene.uniform_sky(.7f);
  const auto color = [](bool on, const char* c) { return on ? c : "0 0 0"; };
  if (r.portal)
    scene.light("window",
                "\"mia_portal_light\" ( \"reverse\" off ) origin 2 0 -1.5 "
                "direction -1 0 0 rectangle 0 0 5 0 2 0 3 3 " +
                    kFewPhotons,
                "");
  scene
      .light("lamp1",
             fmt::format("\"physical_light\" ( \"color\" {} ) origin 0 .99 -2 direction 0 -1 0 "
                         "rectangle .5 0 0 0 0 .5 {}",
                         color(r.lamps, "6 5 4"), kFewPhotons))
      .light("lamp2", fmt::format("\"mib_light_point\" ( \"color\" {}, \"shadow\" on ) "
                                  "origin -1.5 .5 -1 {}",
                                  color(r.lamps, ".3 .4 .3"), kFewPhotons))
      .light("spot", fmt::format("\"mib_light_point\" ( \"color\" {}, \"shadow\" on ) "
                                 "origin 1.5 .7 -3.5 {}",
                                 color(r.spot, ".1 .2 .6"), kFewPhotons));
  std::string text = scene.str();
  const std::string path = "\"indirect\" \"path\"";
  return text.replace(text.find(path), path.size(), "\"indirect\" \"" + r.method + "\"");
}

const std::vector<scene::LightGroup> kGroups = {
    {"key", {"lamp*"}}, {"glow", {"shape5_i"}}, {"sky", {"environment"}}};

/// Its layers after some samples.
std::vector<Layer> rendered(const Room& room, std::uint32_t samples,
                            std::vector<scene::LightGroup> groups = kGroups) {
  PrepareOptions options;
  options.light_groups = std::move(groups);
  const testing::PreparedScene scene(text_of(room), test_registry(), options);
  EXPECT_EQ(scene.messages(), "");
  RenderSession session(*scene.world, {.budget = {.samples = samples}});
  session.run();
  return film_layers(session, LayerSet(LayerGroup::Always));
}

Rgb at(const std::vector<Layer>& layers, const std::string& name, int x, int y) {
  const Layer* layer = find_layer(layers, name);
  if (!layer) throw std::runtime_error("no layer " + name);
  const float* p = layer->image.at(x, y);
  return Rgb(p[0], p[1], p[2]);
}

Rgb mean(const std::vector<Layer>& layers, const std::string& name) {
  Imath::Vec3<double> sum(0.0);  // double: a mean
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) sum += Imath::Vec3<double>(at(layers, name, x, y));
  return Rgb(Vec3(sum / double(kSize * kSize)));
}

void expect_sum(const std::vector<Layer>& layers, const std::string& what) {
  const std::vector<std::string> names = light_layer_names(layers);
  const float floor = 1e-3f * max_component(mean(layers, ""));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      Rgb sum(0);
      for (const std::string& name : names) sum += at(layers, "light_" + name, x, y);
      const Rgb beauty = at(layers, "", x, y);
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(sum[k], beauty[k], 1e-4f * std::max(beauty[k], floor))
            << what << " at " << x << ' ' << y;
    }
}

TEST(LightLayers, SumToTheBeautyInEveryMethod) {
  for (const char* method : {"path", "fg", "photons", "fg+photons"}) {
    const std::vector<Layer> layers = rendered({.method = method}, 4);
    EXPECT_EQ(light_layer_names(layers), (std::vector<std::string>{"key", "glow", "sky", "rest"}));
    expect_sum(layers, method);
    for (const char* name : {"light_key", "light_glow", "light_sky", "light_rest"})
      EXPECT_GT(mean(layers, name).y, 1e-4f) << method << ' ' << name;
  }
}

TEST(LightLayers, NegativeLobesOfFiltersAndLensesKeepTheSum) {
  expect_sum(rendered({.options = "trace depth 4 4 6 filter mitchell"}, 8), "mitchell");
  expect_sum(rendered({.options = "trace depth 4 4 6 filter clip mitchell"}, 8), "clip mitchell");
}

TEST(LightLayers, WithoutItsLightsTheBeautyIsLessByTheLayer) {
  struct Case {
    const char* layer;
    Room off;
  };
  for (const char* method : {"path", "photons", "fg"}) {
    const Room all{.method = method};
    // Photons and gather points are random too: the tolerance is theirs.
    const bool exact = all.method == "path";
    const std::uint32_t samples = exact ? 192 : 16;
    const auto with = rendered(all, samples);
    std::vector<Case> cases = {{"light_key", all}, {"light_glow", all}, {"light_rest", all}};
    cases[0].off.lamps = false;
    cases[1].off.bulb = false;
    cases[2].off.spot = false;
    if (!exact) cases.erase(cases.begin() + 1, cases.end());
    for (const Case& c : cases) {
      auto groups = kGroups;
      if (!c.off.bulb) groups.erase(groups.begin() + 1);  // it no longer emits
      const auto without = rendered(c.off, samples, groups);
      const Rgb whole = mean(with, ""), left = mean(without, ""), part = mean(with, c.layer);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(whole[k] - part[k], left[k], (exact ? .01f : .05f) * whole[k])
            << method << ' ' << c.layer;
    }
  }
}

TEST(LightLayers, LightBelongsToTheFirstMatchingGroup) {
  const auto layers = rendered({}, 2, {{"a", {"lamp1_i"}}, {"all", {"*"}}});
  EXPECT_EQ(light_layer_names(layers), (std::vector<std::string>{"a", "all", "rest"}));
  EXPECT_GT(mean(layers, "light_a").x, 1e-3f);
  EXPECT_GT(mean(layers, "light_all").x, 1e-3f);
  EXPECT_EQ(mean(layers, "light_rest"), Rgb(0)) << "* has everything";
  expect_sum(layers, "a and all");
}

TEST(LightLayers, GroupsOfInstancesAndOptionsNameLights) {
  std::string text = text_of({});
  text.insert(text.find("camera \"cam\""),
              "instgroup \"fixture\" \"spot_i\" end instgroup\n"
              "instance \"fixture_i\" \"fixture\" end instance\n");
  text.replace(text.rfind(" \"spot_i\""), 9, " \"fixture_i\"");
  text.insert(text.find("end options"), "\"light group one\" \"fixture\" ");
  const testing::PreparedScene scene(text, test_registry());
  ASSERT_TRUE(scene.world);
  EXPECT_EQ(scene.messages(), "");
  const LightLayers& layers = scene.world->light_layers;
  ASSERT_EQ(layers.names, std::vector<std::string>{"one"});
  for (std::size_t i = 0; i < layers.of_light.size(); ++i)
    EXPECT_EQ(layers.of_light[i] == 0, scene.world->lights[i].name == "spot_i") << i;
}

TEST(LightLayers, UnmatchedPatternsAreReportedWithTheNearestName) {
  PrepareOptions options;
  options.light_groups = {{"key", {"lump1_i", "grey*", "lamp*"}}};
  const testing::PreparedScene scene(text_of({}), test_registry(), options);
  ASSERT_EQ(scene.diagnostics.all().size(), 2u) << scene.messages();
  for (const Diagnostic& d : scene.diagnostics.all()) EXPECT_EQ(d.code, "OR-RN-057");
  EXPECT_NE(scene.diagnostics.all()[0].message.find("\"lump1_i\""), std::string::npos);
  EXPECT_NE(scene.diagnostics.all()[0].hint.find("\"lamp1_i\""), std::string::npos)
      << scene.messages();
}

TEST(LightLayers, PortalsBelongToTheSkyGroupUnlessNamed) {
  const auto sky = rendered({}, 16, {{"sky", {"environment"}}});
  const auto apart = rendered({}, 16, {{"sky", {"environment"}}, {"window", {"window_i"}}});
  const Rgb together = mean(apart, "light_sky") + mean(apart, "light_window");
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(together[k], mean(sky, "light_sky")[k], 1e-4f * together[k]);
  EXPECT_GT(mean(apart, "light_window").x, .02f);
  EXPECT_GT(mean(apart, "light_sky").x, .02f) << "seen through it";
}

TEST(LightLayers, OtherLayersAreUnchanged) {
  const auto with = rendered({}, 2), without = rendered({}, 2, {});
  const auto &a = find_layer(with, "")->image.pixels, &b = find_layer(without, "")->image.pixels;
  ASSERT_EQ(a.size(), b.size());
  // The same paths; sums of them are added up in another order.
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-5f * (1 + b[i]));
  EXPECT_TRUE(light_layer_names(without).empty());
}

}  // namespace light_layers_test
}  // namespace oriel::testing
