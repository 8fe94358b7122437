// SPDX-License-Identifier: Apache-2.0
// Ray nodes of the base library: visible radiance, and transmission of light.
#include "bsdf/highlights.h"
#include "support/probe.h"

namespace oriel::testing {
namespace ray_nodes_test {

/// A plate at the origin of a material that is one call, its own shadow and photon shader too, over
/// a Lambert surface "l" of albedo one half. White above, a fifth below.
SceneText plate(const std::string& call, const std::string& shadow = "shadow = \"m_s\"") {
  SceneText scene;
  scene.statement("shader \"l\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 )")
      .statement(fmt::format("shader \"m_s\" {}\nmaterial \"m\" = \"m_s\" {} photon = \"m_s\" "
                             "end material",
                             call, shadow))
      .plate("m")
      .environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .2 .2 .2 )");
  return scene;
}
Measured seen(const SceneText& scene, float degrees = 0) {
  return Probe(scene).onto(Vec3(0), kUp, degrees, 8192);
}

TEST(RayNodes, ReflectBlendsTheMirrorOverItsInput) {
  expect_exact("reflect", seen(plate("\"mib_reflect\" ( \"input\" = \"l\", \"reflect\" .3 .6 0 )")),
               Rgb(.7f * .5f + .3f, .4f * .5f + .6f, .5f));
  // A white input in a white room stays white.
  expect_exact("furnace", seen(plate("\"mib_reflect\" ( \"input\" 1 1 1, \"reflect\" .3 .6 0 )")),
               Rgb(1));
}

TEST(RayNodes, ReflectWithoutTracingSeesTheEnvironmentAlone) {
  for (const bool notrace : {false, true}) {
    SceneText scene = plate(fmt::format("\"mib_reflect\" ( \"reflect\" 1 1 1, \"notrace\" {} )",
                                        notrace ? "on" : "off"));
    scene.emitter("glow", 7).square("glow", Vec3(0, 0, 3), 3, -kUp);
    expect_exact("notrace", seen(scene), notrace ? 1.0f : 7.0f);
  }
}

TEST(RayNodes, TransparencyOpacityAndContinueShowTheBackground) {
  const Rgb k(.2f, .5f, 1);
  const Rgb expected = (Rgb(1) - k) * .5f + k * .2f;
  for (const char* call : {"\"mib_transparency\" ( \"input\" = \"l\", \"transp\" .2 .5 1 )",
                           "\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .8 .5 0 )",
                           "\"mib_continue\" ( \"input\" = \"l\", \"transp\" .2 .5 1 )"})
    expect_exact(call, seen(plate(call), 30), expected);
  for (const char* call : {"\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .25 .25 .25 )",
                           "\"mib_continue\" ( \"input\" = \"l\", \"transp\" .75 .75 .75 )"})
    expect_exact(call, seen(plate(call), 30), .25f * .5f + .75f * .2f);
}

TEST(RayNodes, TwosidedShowsTheSideThatIsSeen) {
  const SceneText scene = plate("\"mib_twosided\" ( \"front\" = \"l\", \"back\" 0 .3 0 )");
  expect_exact("front", seen(scene), .5f);
  expect_exact("back", Probe(scene).onto(Vec3(0), -kUp, 0, 64), Rgb(0, .3f, 0));
}

/// A floor of albedo one under the plate, in the light of a sun alone.
Measured floor_under(const std::string& call, const std::string& shadow) {
  SceneText scene = plate(call, shadow);
  scene.environment("\"test_sky\" ( )");
  scene.lambert("floor", 1)
      .square("floor", Vec3(0, 0, -2), 5, kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  return Probe(scene).direct_only().onto(Vec3(0, 0, -2), kUp, 45, 1024);
}

TEST(RayNodes, ShadowsAreAsTransparentAsTheSurface) {
  const struct {
    const char* call;
    Rgb passes;
  } cases[] = {
      {"\"mib_transparency\" ( \"input\" = \"l\", \"transp\" .2 .5 1 )", Rgb(.2f, .5f, 1)},
      {"\"mib_opacity\" ( \"input\" = \"l\", \"opacity\" .8 .5 0 )", Rgb(.2f, .5f, 1)},
      {"\"mib_continue\" ( \"input\" = \"l\", \"transp\" .2 .5 1 )", Rgb(.2f, .5f, 1)},
      {"\"mib_refract\" ( \"input\" = \"l\", \"refract\" .2 .5 1, \"ior\" 1.5 )", Rgb(.2f, .5f, 1)},
      {"\"mib_dielectric\" ( \"input\" = \"l\", \"refract\" .4, \"ior\" 1.5 )", Rgb(.4f)},
      {"\"mib_reflect\" ( \"input\" = \"l\", \"reflect\" .2 .2 .2 )", Rgb(0)},
  };
  for (const auto& c : cases) {
    expect_exact(c.call, floor_under(c.call, "shadow = \"m_s\""), c.passes);
    expect_exact(c.call, floor_under(c.call, ""), 0.0f);
  }
}

TEST(RayNodes, ChainsPassLightAsTheirPartsDo) {
  SceneText scene;
  const std::string transparent =
      "\"mib_reflect\" ( \"input\" = shader \"t\" \"mib_transparency\" ( \"input\" = \"l\", "
      "\"transp\" .5 .5 .5 ), \"reflect\" .2 .2 .2 )";
  expect_exact("through", floor_under(transparent, "shadow = \"m_s\""), .8f * .5f);
  expect_exact("seen", seen(plate(transparent)), .8f * (.5f * .5f + .5f * .2f) + .2f);
}

/// A glass block of thickness 1 above a ground that shows the hit position.
Measured through_glass(const std::string& material_statement) {
  SceneText scene;
  scene.statement(material_statement)
      .statement("shader \"place\" \"test_place\" ( \"scale\" 1 1 0 )")
      .statement("material \"ground\" = \"place\" end material")
      .box("m", Vec3(-20, -20, -1), Vec3(20, 20, 0))
      .square("ground", Vec3(0, 0, -2), 30, kUp);
  return Probe(scene).ray(Vec3(-3, -1, 3), Vec3(3, 1.5f, -3), 64);
}

TEST(RayNodes, RefractionIsThatOfTheArchitecturalGlass) {
  const Measured glass = through_glass(
      "shader \"g\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 0, "
      "\"transparency\" 1, \"refr_ior\" 1.5, \"refr_falloff_on\" off )\n"
      "material \"m\" = \"g\" shadow = \"g\" end material");
  const std::string index = "shader \"i\" \"mib_refraction_index\" ( \"mtl_ior\" 1.5 )\n";
  for (const char* shader :
       {"mib_refract\" ( \"refract\" 1 1 1", "mib_dielectric\" ( \"refract\" 1"})
    expect_same(shader,
                through_glass(fmt::format("{}material \"m\" \"{}, \"ior\" = \"i.ior\" ) "
                                          "end material",
                                          index, shader)),
                glass);
}

TEST(RayNodes, DielectricAbsorbsPerUnitOfLength) {
  SceneText scene;
  scene.statement("shader \"i\" \"mib_refraction_index\" ( \"mtl_ior\" 1.5 )")
      .statement(
          "material \"m\" \"mib_dielectric\" ( \"refract\" 1, \"ior\" = \"i.ior\", "
          "\"absorb\" .5 1 0 ) end material")
      .box("m", Vec3(-20, -20, -2), Vec3(20, 20, 0))
      .uniform_sky(1);
  expect_exact("absorb", Probe(scene).onto(Vec3(0), kUp, 0, 64),
               Rgb(std::exp(-1.0f), std::exp(-2.0f), 1));
}

/// A light that shows what a highlight is worth: radiance / (pi x colour).
float highlight(const std::string& call, const Vec3& to_light, float degrees) {
  SceneText scene;
  scene.statement("material \"m\" " + call + " end material").plate("m");
  scene.light("lamp", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction {}",
                                  text_of(-to_light)));
  const float a = degrees * kPi / 180;
  const Vec3 away(std::sin(a), 0, std::cos(a));
  return Probe(scene).direct_only().ray(away * 2.0f, -away, 64).mean.x;
}

TEST(Illumination, HighlightsAreTheirModels) {
  const Vec3 light = normalize(Vec3(-.5f, .2f, 1));
  const auto local = [&](float degrees) {
    const float a = degrees * kPi / 180;
    return Vec3(std::sin(a), 0, std::cos(a));
  };
  const auto near = [](float a, float b) { EXPECT_NEAR(a, b, 1e-4f * b); };
  near(highlight("\"mib_illum_blinn\" ( \"specular\" 1 1 1, \"roughness\" .3, \"ior\" 1.6 )", light,
                 30),
       kPi * bsdf::TorranceHighlight{.3f, 1.6f}.eval(local(30), light));
  near(highlight("\"mib_illum_cooktorr\" ( \"specular\" 1 1 1, \"roughness\" .3, "
                 "\"ior\" 1.6 2 3 )",
                 light, 30),
       kPi * bsdf::TorranceHighlight{.3f, 1.6f}.eval(local(30), light));
  near(highlight("\"mib_illum_ward\" ( \"glossy\" 1 1 1, \"shiny_u\" 5, \"shiny_v\" 2, "
                 "\"u\" 1 0 0, \"v\" 0 1 0 )",
                 light, 30),
       kPi * bsdf::WardHighlight{.2f, .5f}.eval(local(30), light));
  // Brushed along y.
  const Vec3 o = local(30);
  near(highlight("\"mib_illum_ward\" ( \"glossy\" 1 1 1, \"shiny_u\" 5, \"shiny_v\" 2, "
                 "\"u\" 0 1 0, \"v\" -1 0 0 )",
                 light, 30),
       kPi * bsdf::WardHighlight{.5f, .2f}.eval(o, light));
  near(highlight("\"mib_illum_lambert\" ( \"diffuse\" 1 1 1 )", light, 30), light.z);
}

TEST(Illumination, CookTorranceShiftsInColourAtGrazingAngles) {
  const auto ratio = [](float degrees) {
    SceneText scene;
    scene
        .statement(
            "material \"m\" \"mib_illum_cooktorr\" ( \"specular\" 1 1 1, \"roughness\" .3, "
            "\"ior\" 1.2 1.5 3 ) end material")
        .plate("m");
    const float a = degrees * kPi / 180;
    const Vec3 away(std::sin(a), 0, std::cos(a));
    scene.light("lamp", fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction {} 0 {}",
                                    away.x, -away.z));
    const Rgb c = Probe(scene).direct_only().ray(away * 2.0f, -away, 64).mean;
    return c.z / c.x;
  };
  EXPECT_GT(ratio(10), 20);
  EXPECT_LT(ratio(80), 2.5f);
}

}  // namespace ray_nodes_test
}  // namespace oriel::testing
