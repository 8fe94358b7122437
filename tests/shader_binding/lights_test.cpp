// SPDX-License-Identifier: Apache-2.0
// Parameters of light shaders, and light selection of materials.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "lights/light_sampler.h"
#include "probe.h"

namespace oriel {
namespace lights_test {

constexpr std::string_view kGrey =
    "material \"m\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 ) end material\n";

/// Irradiance of a surface at `place` that faces the only light, divided by pi: the colour that
/// the light's shader returned.
Rgb colour_at(std::string_view light, const Vec3& place) {
  const testing::PreparedScene s(testing::scene_text(
      fmt::format("{} light \"l\" {} end light instance \"li\" \"l\" end instance", kGrey, light),
      "\"li\""));
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  ShadingPoint point;
  point.position = place;
  point.world = s.world.get();
  const auto sample = sample_light(s.world->lights.at(0), point, Vec2(.5f));
  return sample ? sample->irradiance * (1 / kPi) : Rgb(0);
}

void expect_rgb(const Rgb& c, double r, double g, double b) {
  EXPECT_NEAR(c.x, r, 1e-5);
  EXPECT_NEAR(c.y, g, 1e-5);
  EXPECT_NEAR(c.z, b, 1e-5);
}

TEST(LightShaders, PointLightsKeepTheirStrengthUnlessTheyAreRanged) {
  const std::string plain = "\"mib_light_point\" ( \"color\" 3 2 1 ) origin 0 0 0";
  expect_rgb(colour_at(plain, Vec3(0, 0, 1)), 3, 2, 1);
  expect_rgb(colour_at(plain, Vec3(0, 500, 0)), 3, 2, 1);
  const std::string ranged =
      "\"mib_light_point\" ( \"color\" 3 2 1, \"atten\" on, \"start\" 2, \"stop\" 6 ) origin 0 0 0";
  expect_rgb(colour_at(ranged, Vec3(0, 0, 1)), 3, 2, 1);
  expect_rgb(colour_at(ranged, Vec3(0, 0, 2)), 3, 2, 1);
  expect_rgb(colour_at(ranged, Vec3(0, 3, 0)), 2.25, 1.5, .75);
  expect_rgb(colour_at(ranged, Vec3(5, 0, 0)), .75, .5, .25);
  expect_rgb(colour_at(ranged, Vec3(6, 0, 0)), 0, 0, 0);
}

TEST(LightShaders, SpotsFadeBetweenTheConesOverTheCosine) {
  const std::string spot =
      "\"mib_light_spot\" ( \"color\" 1 1 1, \"cone\" .9 ) origin 0 0 0 direction 0 0 -1 spread .7";
  const auto at = [&](float cosine) {
    return colour_at(spot, Vec3(std::sqrt(1 - cosine * cosine), 0, -cosine) * 4).x;
  };
  EXPECT_NEAR(at(1), 1, 1e-5);
  EXPECT_NEAR(at(.91f), 1, 1e-5);
  EXPECT_NEAR(at(.8f), .5, 1e-4);
  EXPECT_NEAR(at(.75f), .25, 1e-4);
  EXPECT_EQ(at(.69f), 0);
  EXPECT_EQ(at(-.5f), 0);
}

TEST(LightShaders, InfiniteLightsComeFromTheirDirectionWithoutDecay) {
  const std::string light = "\"mib_light_infinite\" ( \"color\" 3 2 1 ) direction 1 0 -1";
  expect_rgb(colour_at(light, Vec3(0)), 3, 2, 1);
  expect_rgb(colour_at(light, Vec3(1e4f)), 3, 2, 1);
}

TEST(LightShaders, PhysicalLightsSpreadTheirEnergyOverTheSphere) {
  const std::string light = "\"physical_light\" ( \"color\" 100 50 25 ) origin 0 0 0";
  const double share = 100 / (4 * 3.14159265358979);
  expect_rgb(colour_at(light, Vec3(0, 0, 1)), share, share / 2, share / 4);
  expect_rgb(colour_at(light, Vec3(0, 2, 0)), share / 4, share / 8, share / 16);
  expect_rgb(colour_at(light + " exponent 1", Vec3(0, 2, 0)), share / 2, share / 4, share / 8);
}

TEST(LightShaders, PhysicalLightsBelowTheirThresholdAreDropped) {
  const std::string light =
      "\"physical_light\" ( \"color\" 100 0 0, \"threshold\" 1 ) origin 0 0 0";
  EXPECT_GT(colour_at(light, Vec3(0, 0, 2)).x, 1);
  EXPECT_EQ(colour_at(light, Vec3(0, 0, 3)).x, 0);
}

/// Three lights, the first two in a group; a material and statements of its instance.
std::set<std::string> lights_of(std::string_view arguments, std::string_view link = {}) {
  const std::string light = "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 0";
  std::string elements =
      fmt::format("material \"m\" \"mia_material\" ( {} ) end material light \"l\" {} end light\n",
                  arguments, light);
  for (const char* name : {"a", "b", "c"})
    elements += fmt::format("instance \"{}\" \"l\" end instance ", name);
  elements += "instgroup \"g\" \"a\" \"b\" end instgroup instance \"pair\" \"g\" end instance\n";
  std::string text = testing::scene_text(elements, "\"pair\" \"c\"");
  const std::string plain = "material [ \"m\" ] end instance";
  text.replace(text.find(plain), plain.size(),
               fmt::format("material [ \"m\" ] {} end instance", link));
  const testing::PreparedScene s(text);
  EXPECT_TRUE(s.world && s.diagnostics.all().empty()) << s.messages();
  EXPECT_EQ(s.world->lights.size(), 3u);
  ShadingPoint point;
  point.world = s.world.get();
  point.position = Vec3(0, 0, -5);
  for (std::size_t i = 0; i < s.world->instances.size(); ++i)
    if (s.world->instances[i].name == "square_inst") point.instance = static_cast<int>(i);
  EXPECT_GE(point.instance, 0);
  Closure closure;
  shade(*s.material("m"), point, closure);
  const LitVertex vertex(*s.world, point, closure);
  std::set<std::string> names;
  for (int i = 0; i < 3; ++i)
    if (s.world->light_sampler->expected_samples(vertex, i) > 0)
      names.insert(s.world->lights[static_cast<std::size_t>(i)].name);
  return names;
}

using Names = std::set<std::string>;

// acceptance: P7
TEST(LightLists, ModesChooseAmongListLinksAndAll) {
  const std::string list = "\"lights\" [ \"c\" ], \"mode\" ";
  EXPECT_EQ(lights_of(list + "0"), (Names{"c"}));
  EXPECT_EQ(lights_of(list + "1"), (Names{"c"}));
  EXPECT_EQ(lights_of(list + "2"), (Names{"a", "b"}));
  EXPECT_EQ(lights_of(list + "4"), (Names{"a", "b", "c"}));
  EXPECT_EQ(lights_of("\"mode\" 0"), (Names{"a", "b", "c"}));
  EXPECT_EQ(lights_of("\"mode\" 1"), (Names{}));
  EXPECT_EQ(lights_of("\"mode\" 2"), (Names{"a", "b", "c"}));
  // Unwritten is 4.
  EXPECT_EQ(lights_of("\"lights\" [ \"c\" ]"), (Names{"a", "b", "c"}));
}

// acceptance: P7
TEST(LightLists, GroupsExpandToTheirLights) {
  EXPECT_EQ(lights_of("\"lights\" [ \"pair\" ], \"mode\" 1"), (Names{"a", "b"}));
  EXPECT_EQ(lights_of("\"lights\" [ \"pair\" ], \"mode\" 2"), (Names{"c"}));
}

// acceptance: P7
TEST(LightLists, InstancesLinkTheirLights) {
  EXPECT_EQ(lights_of("", "light [ \"a\" ]"), (Names{"a"}));
  EXPECT_EQ(lights_of("", "light \"exclusive\" [ \"a\" ]"), (Names{"b", "c"}));
  EXPECT_EQ(lights_of("\"mode\" 0", "light [ \"a\" ]"), (Names{"a"}));
  // A list of the material takes precedence over the links of the instance.
  EXPECT_EQ(lights_of("\"lights\" [ \"c\" ], \"mode\" 0", "light [ \"a\" ]"), (Names{"c"}));
  EXPECT_EQ(lights_of("\"lights\" [ \"c\" ], \"mode\" 1", "light [ \"a\" ]"), (Names{"c"}));
}

}  // namespace lights_test
}  // namespace oriel
