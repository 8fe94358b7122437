// SPDX-License-Identifier: Apache-2.0
// Explanations of pixels: they sum to the image, and are correct for simple scenes.
#include <array>

#include "analysis/explain.h"
#include "color/luminance.h"
#include "mi/reader.h"
#include "support/picture.h"

namespace oriel::testing {
namespace explain_test {

/// A scene made ready, which explanations may part by its sources.
struct Prepared {
  Diagnostics diagnostics;
  scene::Scene scene;
  std::unique_ptr<World> world;

  explicit Prepared(const SceneText& text, scene::IndirectMethod gi = scene::IndirectMethod::Path) {
    mi::ReadOptions options;
    options.packages = builtin_packages();
    options.knows_shader = [](std::string_view n) { return test_registry().find(n) != nullptr; };
    scene = mi::read_text(text.str(), options, diagnostics);
    PrepareReport report;
    world = prepare(scene, scene.renders.back(), test_registry(), {}, diagnostics, report);
    for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << diagnostics.format(d);
    world->options.indirect = gi;
  }
  Explanation at(int x, int y, std::uint32_t samples = 64) const {
    return explain_pixel(*world, {.budget = {.samples = samples}}, x, y, {});
  }
};

/// The surface of that instance which paths came to that way; fails where there is none.
const ExplainedSurface* find(const Explanation& e, const World& world, PathSegment segment,
                             const std::string& instance) {
  for (const ExplainedSurface& s : e.surfaces)
    if (s.segment == segment && s.instance >= 0 &&
        world.instances[static_cast<std::size_t>(s.instance)].name == instance)
      return &s;
  return nullptr;
}

Rgb light_of(const Explanation& e, const ExplainedSurface& s, Aov part, const std::string& source) {
  Rgb sum(0);
  for (const ExplainedLight& l : s.light)
    if (l.part == part && e.sources[l.source] == source) sum += l.light;
  return sum;
}

/// A plate that fills the picture, seen straight on from 1 away; light may come from the front.
SceneText plate(const std::string& parameters, const std::string& camera = {}) {
  SceneText scene;
  scene.material("m", parameters)
      .square("m", Vec3(0, 0, -1), 3, kUp)
      .camera("focal 1 aperture .2 aspect 1 resolution 6 6 " + camera);
  return scene;
}
constexpr const char* kGrey = "\"reflectivity\" 0, \"diffuse\" .5 .5 .5";

std::string sun(float colour, const char* direction = "0 0 -1", bool shadow = true) {
  return fmt::format(
      "\"mib_light_infinite\" ( \"color\" {0} {0} {0}, \"shadow\" {2} ) direction {1}", colour,
      direction, shadow ? "on" : "off");
}
/// Light from behind the plate, onto what faces it.
std::string light_through_the_plate() { return sun(1, "0 0 1", false); }

/// A room with all that light can do: glass before a mirror, a glossy floor, a lamp with a shape, a
/// surface that glows, a sky behind an opening.
SceneText room() {
  SceneText scene(
      "trace depth 8 8 12 shadow segments finalgather on \"finalgather rays\" 16 globillum on "
      "caustic off");
  scene.lambert("wall", .6f)
      .material("floor", "\"reflectivity\" .4, \"refl_gloss\" .6, \"diffuse\" .7 .3 .2")
      .material("mirror", "\"reflectivity\" 1, \"brdf_0_degree_refl\" .9, \"diffuse_weight\" 0")
      .material("glass", "\"transparency\" .8, \"reflectivity\" .2, \"refr_ior\" 1.5")
      .emitter("glow", 3)
      .square("floor", Vec3(0, -1, -2), 3, Vec3(0, 1, 0))
      .square("wall", Vec3(0, 1, -2), 3, Vec3(0, -1, 0))
      .square("mirror", Vec3(.5f, 0, -3), 1, kUp)
      .square("wall", Vec3(-1.5f, 0, -3), 1, kUp)
      .sphere("glass", Vec3(.3f, -.2f, -1.8f), .3f)
      .square("glow", Vec3(-1.4f, .2f, -1.5f), .2f, Vec3(1, 0, 0))
      .light("lamp",
             "\"physical_light\" ( \"color\" 20 20 20 ) origin 0 .9 -2 direction 0 -1 0 "
             "energy 60 60 60 globillum photons 3000 "
             "rectangle .4 0 0 0 0 .4 3 3",
             "visible on")
      .uniform_sky(.4f)
      .camera("focal 1 aperture 1.2 aspect 1.5 resolution 12 8");
  return scene;
}

TEST(Explain, SharesSumToThePixelOfTheWholePicture) {
  using Method = scene::IndirectMethod;
  for (const Method gi : {Method::Path, Method::FinalGather, Method::Photons}) {
    const Prepared room_of(room(), gi);
    const std::array<std::array<int, 2>, 3> pixels = {{{2, 6}, {7, 4}, {0, 0}}};
    RenderSession whole(*room_of.world, {.budget = {.samples = 32}});
    whole.run();
    for (const auto& [x, y] : pixels) {
      const Explanation e = room_of.at(x, y, 32);
      const Rgb rendered = rgb(whole.film().pixel(x, y).beauty);
      expect_near(e.colour, rendered, 1e-6f,
                  fmt::format("the picture's pixel {} {}, method {}", x, y, static_cast<int>(gi)));
      expect_near(e.total(0), e.colour, 1e-4f, "all shares");
      Rgb parts(0);
      for (const Rgb& part : e.parts) parts += part;
      expect_near(parts, e.colour, 1e-4f, "all outputs");
    }
  }
}

TEST(Explain, SeparateLightsKeepThePicture) {
  // Sums that keep lights apart are rounded in other places.
  using Method = scene::IndirectMethod;
  for (const Method gi : {Method::Path, Method::FinalGather, Method::Photons}) {
    const Prepared room_of(room(), gi), parted(room(), gi);
    separate_light_layers(*parted.world);
    RenderSession whole(*room_of.world, {.budget = {.samples = 4}}),
        by_light(*parted.world, {.budget = {.samples = 4}});
    whole.run();
    by_light.run();
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x)
        expect_near(rgb(whole.film().pixel(x, y).beauty), rgb(by_light.film().pixel(x, y).beauty),
                    1e-5f, fmt::format("pixel {} {}, method {}", x, y, static_cast<int>(gi)));
  }
}

TEST(Explain, SharesSumThroughAFilterWithNegativeLobesAndALens) {
  SceneText text("trace depth 8 8 12 shadow segments filter mitchell 4 4");
  text.lambert("floor", .5f)
      .square("floor", Vec3(0, -1, -2), 3, Vec3(0, 1, 0))
      .uniform_sky(1)
      .light("sun", sun(2, "0 -1 0"))
      .camera(
          "focal 1 aperture 1.2 aspect 1 resolution 8 8 lens \"mia_lens_bokeh\" "
          "( \"on\" on, \"plane\" 2, \"radius\" .1, \"samples\" 4 )");
  const Prepared floor(text);
  for (const int y : {3, 4, 6}) {
    const Explanation e = floor.at(3, y);
    EXPECT_GT(e.colour.x, 0) << y;
    expect_near(e.total(0), e.colour, 1e-4f, "all shares");
  }
}

TEST(Explain, LightsHaveTheirContributions) {
  const Prepared suns(plate(kGrey).light("strong", sun(3)).light("weak", sun(1)));
  const Explanation e = suns.at(3, 3);
  const ExplainedSurface* s = find(e, *suns.world, PathSegment::Eye, "shape0_i");
  ASSERT_NE(s, nullptr);
  expect_near(light_of(e, *s, Aov::Diffuse, "strong_i"), Rgb(1.5f), 1e-5f, "albedo x 3");
  expect_near(light_of(e, *s, Aov::Diffuse, "weak_i"), Rgb(.5f), 1e-5f, "albedo x 1");
  EXPECT_NEAR(s->distance, 1, .01);
  EXPECT_NEAR(s->hits, 1, 1e-6);
  ASSERT_EQ(s->lobes.size(), 1u);
  EXPECT_EQ(s->lobes[0].kind, LobeKind::Diffuse);
  expect_near(s->lobes[0].weight, Rgb(.5f), 1e-5f, "albedo");
}

TEST(Explain, ShadowsNameTheirBlockers) {
  const Prepared shaded(plate(kGrey)
                            .lambert("lid", 0)
                            .square("lid", Vec3(0, 0, 1), 3, kUp)
                            .light("sun", sun(2))
                            .light("below", sun(2, "0 0 1")));
  const Explanation e = shaded.at(3, 3);
  const ExplainedSurface* s = find(e, *shaded.world, PathSegment::Eye, "shape0_i");
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->lights.size(), 2u);
  for (const ExplainedLightSource& lamp : s->lights) {
    EXPECT_EQ(lamp.unoccluded, Rgb(0));
    if (shaded.world->lights[static_cast<std::size_t>(lamp.light)].name == "below_i") {
      EXPECT_EQ(lamp.unshadowed, Rgb(0)) << "the surface faces away";
      continue;
    }
    EXPECT_NEAR(lamp.unshadowed.x / static_cast<float>(lamp.samples), 1, 1e-5);
    ASSERT_EQ(lamp.blockers.size(), 1u);
    EXPECT_EQ(shaded.world->instances[static_cast<std::size_t>(lamp.blockers.begin()->first)].name,
              "shape1_i");
  }
}

TEST(Explain, MirrorsShowTheReflectedSurface) {
  const Prepared mirror(
      plate("\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" .8, "
            "\"brdf_90_degree_refl\" .8")
          .lambert("wall", .5f)
          .square("wall", Vec3(0, 0, 1), 3, -kUp)
          .light("sun", light_through_the_plate()));
  const Explanation e = mirror.at(3, 3);
  const ExplainedSurface* wall = find(e, *mirror.world, PathSegment::Reflection, "shape1_i");
  ASSERT_NE(wall, nullptr);
  EXPECT_EQ(wall->from, 1u) << "seen in the plate";
  expect_near(light_of(e, *wall, Aov::Diffuse, "sun_i"), Rgb(.4f), 1e-4f,
              "albedo x level of the mirror");
  expect_near(e.total(1), e.colour, 1e-5f, "all is reflection");
}

TEST(Explain, BouncesNameTheSurfaceTheyComeFrom) {
  const Prepared lit(plate(kGrey)
                         .lambert("wall", .8f)
                         .square("wall", Vec3(0, 0, 2), 3, -kUp)
                         .light("sun", light_through_the_plate()));
  const Explanation e = lit.at(3, 3, 256);
  const ExplainedSurface* wall = find(e, *lit.world, PathSegment::Diffuse, "shape1_i");
  ASSERT_NE(wall, nullptr);
  EXPECT_TRUE(wall->behind);
  EXPECT_GT(luminance(e.colour), .1f);
  EXPECT_NEAR(luminance(wall->total()), luminance(e.colour), 1e-4 * luminance(e.colour));
}

TEST(Explain, ConnectedParametersHaveTheirValues) {
  SceneText text;
  text.statement("shader \"there\" \"test_place\" ( \"scale\" 0 0 -.25 )")
      .material("m", "\"reflectivity\" 0, \"diffuse\" = \"there\"")
      .square("m", Vec3(0, 0, -2), 3, kUp)
      .uniform_sky(1)
      .camera("focal 1 aperture .2 aspect 1 resolution 6 6");
  const Prepared placed(text);
  const Explanation e = placed.at(3, 3, 4);
  ASSERT_GE(e.surfaces.size(), 2u);
  ASSERT_EQ(e.surfaces[1].parameters.size(), 1u);
  const ExplainedParameter& p = e.surfaces[1].parameters[0];
  EXPECT_EQ(p.name, "diffuse");
  EXPECT_EQ(p.source, "test_place");
  ASSERT_EQ(p.values.size(), 4u);
  EXPECT_NEAR(p.values[2], .5f, 1e-5);
}

}  // namespace explain_test
}  // namespace oriel::testing
