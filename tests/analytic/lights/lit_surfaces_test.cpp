// SPDX-License-Identifier: Apache-2.0
// Surfaces that directional lights illuminate, sampled as lights.
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "shaders/registry.h"
#include "support/picture.h"
#include "support/probe.h"

namespace oriel::testing {
namespace lit_surfaces_test {

constexpr const char* kSun = "\"mib_light_infinite\" ( \"color\" 4 4 4, \"shadow\" on ) ";

/// A room of 4 x 4 x 3 around the origin, with a window of 1 x 1 in the wall at x = 2, whose lower
/// edge is 1 above the floor. The camera looks from the wall at x = -2 to the window.
class Room {
 public:
  explicit Room(const std::string& options = "trace depth 8 8 12 shadow segments") : text(options) {
    text.lambert("white", .5f).lambert("red", .5f);
    text.camera("focal 1 aperture 1.6 aspect 1.5 resolution 48 32",
                "transform 0 0 -1 0 -1 0 0 0 0 1 0 0 0 -1.5 -1.9 1");
  }
  Room& walls(const std::string& floor = "white", const std::string& others = "white") {
    text.polygon(floor, {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(2, 2, 0), Vec3(-2, 2, 0)});
    text.polygon(others, {Vec3(-2, -2, 3), Vec3(2, -2, 3), Vec3(2, 2, 3), Vec3(-2, 2, 3)});
    text.polygon(others, {Vec3(-2, -2, 0), Vec3(-2, 2, 0), Vec3(-2, 2, 3), Vec3(-2, -2, 3)});
    text.polygon(others, {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(2, -2, 3), Vec3(-2, -2, 3)});
    text.polygon(others, {Vec3(-2, 2, 0), Vec3(2, 2, 0), Vec3(2, 2, 3), Vec3(-2, 2, 3)});
    const auto board = [&](float y0, float z0, float y1, float z1) {
      text.polygon(others, {Vec3(2, y0, z0), Vec3(2, y1, z0), Vec3(2, y1, z1), Vec3(2, y0, z1)});
    };
    board(-2, 0, 2, 1);
    board(-2, 2, 2, 3);
    board(-2, 1, -.5f, 2);
    board(.5f, 1, 2, 2);
    return *this;
  }
  Room& pane(const std::string& material) {
    text.polygon(material, {Vec3(2, -.5f, 1), Vec3(2, .5f, 1), Vec3(2, .5f, 2), Vec3(2, -.5f, 2)});
    return *this;
  }
  Room& sun(const std::string& name = "sun", const std::string& direction = "-1 .2 -1.2",
            const std::string& shader = kSun) {
    text.light(name, shader + "direction " + direction);
    return *this;
  }

  SceneText text;
};

/// Paths with and without the samples have the same mean.
void expect_same_light(const std::string& name, const SceneText& text, int samples = 1 << 15,
                       float largest_error = .03f) {
  const std::string scene = text.str();
  Probe sampled(scene);
  sampled.lit_surfaces();
  ASSERT_TRUE(sampled.has_lit_surfaces()) << name;
  expect_same(name, sampled.picture(samples), Probe(scene).picture(samples * 8), largest_error);
}

TEST(LitSurfaces, ACardAboveAPatchOfSunMatchesTheFormFactor) {
  // The sun shines through a hole of 1 x 1 in a black board onto a square of the floor; a white
  // card above the middle of the square faces it.
  for (const float albedo : {.25f, 1.0f}) {
    SceneText scene;
    scene.lambert("floor", albedo).lambert("card", 1).lambert("black", 0);
    scene.square("floor", Vec3(0), 20, kUp);
    scene.square("card", Vec3(0, 0, 1), .01f, -kUp);
    const auto board = [&](float x0, float y0, float x1, float y1) {
      scene.polygon("black", {Vec3(x0, y0, 2), Vec3(x1, y0, 2), Vec3(x1, y1, 2), Vec3(x0, y1, 2)});
    };
    board(-60, -60, 60, -.5f);
    board(-60, .5f, 60, 60);
    board(-60, -.5f, 2 - .5f, .5f);
    board(2 + .5f, -.5f, 60, .5f);
    scene.light("sun", std::string(kSun) + "direction -1 0 -1");
    // From below and far away; of all surfaces that rays meet few are lit.
    scene.camera("focal 1 aperture 4 aspect 1 resolution 16 16",
                 "transform 1 0 0 0 0 1 0 0 0 0 1 0 0 -2 -1.5 1");
    Probe probe(scene);
    probe.lit_surfaces();
    ASSERT_TRUE(probe.has_lit_surfaces());
    // A colour of 4 is an irradiance of 4 pi; at 45 degrees, and 1 / pi from exitance to radiance.
    const float patch = 4 * std::sqrt(.5f) * albedo;
    expect_exact(fmt::format("patch of albedo {}", albedo),
                 probe.onto(Vec3(0, 0, 1), -kUp, 40, 65536, .02f),
                 patch * static_cast<float>(.7522747 / kPi));
  }
}

TEST(LitSurfaces, RoomsHaveTheSameLight) {
  expect_same_light("window", Room().walls().sun().text);
  expect_same_light("two suns", Room().walls().sun().sun("other", "-1 -.4 -.8").text);
  expect_same_light("soft sun",
                    Room()
                        .walls()
                        .sun("sun", "-1 .2 -1.2",
                             "\"mia_physicalsun\" ( \"multiplier\" .00002, \"horizon_height\" -2, "
                             "\"samples\" 8, \"shadow_softness\" 4 ) ")
                        .text);
  Room rough;
  rough.text.material("rough",
                      "\"diffuse\" .5 .5 .5 1, \"diffuse_roughness\" .8, "
                      "\"reflectivity\" 0");
  expect_same_light("rough floor", rough.walls("rough").sun().text);
}

TEST(LitSurfaces, GlossySurfacesHaveTheSameLight) {
  const auto room = [](const std::string& floor, const std::string& others) {
    Room glossy;
    glossy.text.material("glossy",
                         "\"diffuse\" .4 .4 .4 1, \"reflectivity\" .5, \"refl_gloss\" .3, "
                         "\"brdf_fresnel\" off, \"brdf_0_degree_refl\" .6");
    glossy.text.material("mirror",
                         "\"diffuse\" .2 .2 .2 1, \"reflectivity\" .8, \"brdf_fresnel\" off, "
                         "\"brdf_0_degree_refl\" .9");
    return glossy.walls(floor, others).sun().text;
  };
  expect_same_light("glossy floor", room("glossy", "white"), 1 << 15, .1f);
  expect_same_light("glossy walls", room("white", "glossy"), 1 << 15, .1f);
  expect_same_light("mirrors", room("white", "mirror"), 1 << 15, .1f);
}

TEST(LitSurfaces, TransparentSurfacesHaveTheSameLight) {
  Room pane;
  pane.text.material("glass",
                     "\"diffuse_weight\" 0, \"reflectivity\" 1, \"transparency\" 1, "
                     "\"refr_color\" .5 .9 .7 1, \"thin_walled\" on");
  expect_same_light("tinted pane", pane.walls().pane("glass").sun().text);
  Room curtain;
  curtain.text.material("curtain",
                        "\"diffuse\" .8 .8 .8 1, \"reflectivity\" 0, "
                        "\"transparency\" .6, \"refr_translucency\" on, "
                        "\"refr_trans_weight\" .5, \"thin_walled\" on");
  expect_same_light("curtain", curtain.walls().pane("curtain").sun().text);
  Room holes;
  holes.text.material("holes",
                      "\"diffuse\" .8 .8 .8 1, \"reflectivity\" 0, "
                      "\"cutout_opacity\" .4");
  expect_same_light("cut-outs", holes.walls().pane("holes").sun().text);
  // A table of glass over a corner of the patch, and over half of it.
  for (const float end : {1.0f, 1.35f}) {
    Room table;
    table.text.material("glass",
                        "\"diffuse_weight\" 0, \"reflectivity\" 1, \"transparency\" 1, "
                        "\"thin_walled\" on");
    table.walls().sun().text.polygon(
        "glass", {Vec3(-1, -1, .7f), Vec3(end, -1, .7f), Vec3(end, 1, .7f), Vec3(-1, 1, .7f)});
    expect_same_light(fmt::format("table of glass up to {}", end), table.text, 1 << 16);
  }
}

TEST(LitSurfaces, FlagsOfLightsAndObjectsHaveTheSameEffect) {
  Room flags;
  flags.walls().sun();
  // One box casts no shadow, one is not seen by rays, one receives none; all stand in the sun.
  const auto box = [&](float y, const std::string& object_flags) {
    flags.text.polygon(
        "red",
        {Vec3(-.3f, y, .4f), Vec3(.5f, y, .4f), Vec3(.5f, y + .3f, .4f), Vec3(-.3f, y + .3f, .4f)},
        object_flags);
  };
  box(-.5f, "shadow off");
  box(0, "finalgather off");
  box(.3f, "shadow 1");
  expect_same_light("flags", flags.text);
  const char* shadowless = "\"mib_light_infinite\" ( \"color\" 2 2 2 ) ";
  expect_same_light("a light without shadows",
                    Room().walls().sun("sun", "-1 .2 -1.2", shadowless).text);
}

TEST(LitSurfaces, TheEstimatorsAgree) {
  const std::string scene = Room().walls().sun().text.str();
  const Measured by_rays = Probe(scene).picture(1 << 18);
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
    Probe probe(scene);
    probe.lit_surfaces().estimator(e);
    expect_same(fmt::format("estimator {}", static_cast<int>(e)), probe.picture(1 << 16), by_rays,
                .03f);
  }
}

TEST(LitSurfaces, RoomsHaveLessNoise) {
  const std::string scene = Room().walls().sun().text.str();
  Probe sampled(scene);
  const Measured with = sampled.lit_surfaces().picture(1 << 16),
                 without = Probe(scene).picture(1 << 16);
  EXPECT_LT(with.error.x, without.error.x / 1.5f);
}

TEST(LitSurfaces, AreNotSampledOutdoors) {
  SceneText outdoors;
  outdoors.lambert("white", .7f).plate("white").square("white", Vec3(0, 0, .5f), .5f, kUp);
  outdoors.light("sun", std::string(kSun) + "direction -1 .2 -1.2");
  outdoors.uniform_sky(1).camera("focal 1 aperture 1 aspect 1 resolution 16 16",
                                 "transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -3 1");
  Probe probe(outdoors);
  EXPECT_FALSE(probe.lit_surfaces().has_lit_surfaces());
  Probe none(Room().walls().text);
  EXPECT_FALSE(none.lit_surfaces().has_lit_surfaces()) << "no light";
}

TEST(LitSurfaces, AreSearchedForPicturesOfManyPaths) {
  const std::string scene =
      Room("trace depth 8 8 12 \"indirect\" \"path\"").walls().sun().text.str();
  const auto rays_before = [&](std::uint32_t samples) {
    PreparedScene prepared(scene, builtin_shaders());
    SessionSettings settings;
    settings.budget.samples = samples;
    RenderSession session(*prepared.world, settings);
    session.run();
    return session.rays_before();
  };
  EXPECT_EQ(rays_before(4), 0u) << "6144 paths";
  EXPECT_GT(rays_before(88), 100'000u) << "135 168 paths";
}

}  // namespace lit_surfaces_test
}  // namespace oriel::testing
