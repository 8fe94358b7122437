// SPDX-License-Identifier: Apache-2.0
// Outputs of the material: the light paths in each of them.
#include "image/recombine.h"
#include "output/output_names.h"
#include "support/picture.h"

namespace oriel::testing {
namespace outputs_test {

/// A plate that fills the picture, seen straight on from 1 away; light may come from the front.
SceneText plate(const std::string& parameters,
                const std::string& options = "trace depth 8 8 12 shadow segments") {
  SceneText scene(options);
  scene.material("m", parameters)
      .square("m", Vec3(0, 0, -1), 3, kUp)
      .camera("focal 1 aperture .2 aspect 1 resolution 6 6");
  return scene;
}

constexpr const char* kSun = "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 0 -1";
constexpr const char* kSunBehind = "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 0 1";
constexpr const char* kLambert = "\"reflectivity\" 0, \"diffuse\" .5 .5 .5";
constexpr const char* kGlossy =
    "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" .8, \"refl_gloss\" .3";

// acceptance: U1
TEST(Outputs, AllLayersExist) {
  const Picture p(plate(kLambert).light("sun", kSun), 4);
  ASSERT_EQ(material_output_names().size(), 25u) << "the manual's 24 and `other`";
  for (const std::string& name : material_output_names()) {
    ASSERT_NE(find_layer(p.layers(), name), nullptr) << name;
    EXPECT_EQ(p.layer(name).channels, name == "opacity" ? 1 : 3) << name;
  }
  EXPECT_EQ(p.layers().size(), 26u);
  EXPECT_TRUE(unusable_outputs(p.layers()).empty());
}

// acceptance: U2
TEST(Outputs, DirectLightIsDiffuse) {
  const Picture p(plate(kLambert).light("sun", kSun));
  expect_only(p, {"diffuse_result"}, "sunlit plate");
  expect_near_color(p.mean("diffuse_result"), Rgb(.5f), 1e-5f, "albedo x light");
  expect_near_color(p.mean("diffuse_raw"), Rgb(1), 1e-5f, "light");
  expect_near_color(p.mean("diffuse_level"), Rgb(.5f), 1e-5f, "albedo");
}

TEST(Outputs, AreaLightsThatRaysFindAreDirectLight) {
  // Found by diffuse rays and by samples of the light: both are the light's, not its bounce.
  for (const char* flags : {"", "visible on"}) {
    const Picture p(plate(kLambert).light("lamp",
                                          "\"physical_light\" ( \"color\" 40 40 40 ) origin 0 0 .5 "
                                          "direction 0 0 -1 rectangle 4 0 0 0 4 0 3 3",
                                          flags));
    expect_only(p, {"diffuse_result"}, std::string("area light ") + flags);
  }
}

// An emissive surface has the outputs of another material at the same place.
TEST(Outputs, ConnectionsTakeEachOfThem) {
  constexpr const char* kShown =
      "\"reflectivity\" .4, \"brdf_0_degree_refl\" 1, "
      "\"refl_color\" 1 .5 .25, \"diffuse\" .8 .4 .2";
  const auto lit = [](SceneText scene) { return scene.light("sun", kSun).uniform_sky(2); };
  const Picture whole(lit(plate(kShown)), 256);
  for (const std::string name : {"result", "diffuse_raw", "diffuse_result", "refl_level",
                                 "refl_result", "indirect_result", "spec_result"}) {
    SceneText scene = plate(
        "\"reflectivity\" 0, \"diffuse_weight\" 0, "
        "\"additional_color\" = \"shown." +
        name + "\"");
    scene.statement(fmt::format("shader \"shown\" \"mia_material_x\" ( {} )", kShown));
    const Picture p(lit(scene), 256);
    expect_near_color(p.mean("result"), whole.mean(name), .01f * whole.mean("result").x, name);
    expect_only(
        p, name == "spec_result" ? std::set<std::string>{} : std::set<std::string>{"add_result"},
        name);
  }
  EXPECT_GT(whole.mean("indirect_result").x, .1f);
}

// acceptance: U2
TEST(Outputs, EnvironmentAndBouncesAreIndirect) {
  const Picture sky(plate(kLambert).uniform_sky(2));
  expect_only(sky, {"indirect_result"}, "plate under a sky");
  expect_near_color(sky.mean("indirect_result"), Rgb(1), 1e-3f, "albedo x sky");
  expect_near_color(sky.mean("indirect_raw"), Rgb(2), 1e-3f, "sky");
  expect_near_color(sky.mean("ao_raw"), Rgb(1), 0, "nothing occludes");

  // A wall that a sun lights from behind the plate, which casts no shadow of it.
  SceneText bounce = plate(kLambert);
  bounce.lambert("wall", .8f).square("wall", Vec3(0, 0, 2), 3, -kUp).light("sun", kSunBehind);
  const Picture p(bounce);
  expect_only(p, {"indirect_result"}, "plate that faces a lit wall");
}

// acceptance: U2
TEST(Outputs, HighlightsAreSpecularAndMirrorsReflection) {
  const Picture highlight(plate(kGlossy).light("sun", kSun));
  expect_only(highlight, {"spec_result"}, "glossy plate under a sharp light");
  const Picture mirror(plate("\"reflectivity\" 1, \"diffuse_weight\" 0, "
                             "\"brdf_0_degree_refl\" .8")
                           .uniform_sky(3));
  expect_only(mirror, {"refl_result"}, "mirror under a sky");
  expect_near_color(mirror.mean("refl_level"), Rgb(.8f), 1e-4f, "reflectivity");
  expect_near_color(mirror.mean("refl_raw"), Rgb(3), 1e-4f, "sky");
  const Picture glossy(plate(kGlossy).uniform_sky(3));
  expect_only(glossy, {"refl_result"}, "glossy plate under a sky");
}

// acceptance: U2
TEST(Outputs, VisibleLightsAreReflectionInvisibleOnesHighlight) {
  const auto lit = [](const char* flags, const char* more = "") {
    return Picture(plate(std::string(kGlossy) + more)
                       .light("lamp",
                              "\"physical_light\" ( \"color\" 40 40 40 ) origin 0 0 1 "
                              "direction 0 0 -1 rectangle 2 0 0 0 2 0 3 3",
                              flags));
  };
  const Picture invisible = lit(""), visible = lit("visible on");
  expect_only(invisible, {"spec_result"}, "invisible light");
  expect_only(visible, {"refl_result"}, "visible light");
  expect_only(lit("visible on", ", \"no_visible_area_hl\" off"), {"refl_result", "spec_result"},
              "visible light with highlight");
  expect_near_color(invisible.mean("spec_raw"), visible.mean("refl_raw"), .02f, "one or the other");
}

// acceptance: U2
TEST(Outputs, GlassIsRefractionAndTheOtherSideTranslucency) {
  const Picture pane(plate("\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, "
                           "\"thin_walled\" on, \"refr_color\" 1 .5 .25")
                         .uniform_sky(2));
  expect_only(pane, {"refr_result"}, "pane");
  expect_near_color(pane.mean("refr_level"), Rgb(1, .5f, .25f), 1e-4f, "colour of the pane");
  expect_near_color(pane.mean("refr_raw"), Rgb(2), 1e-4f, "what lies behind");

  constexpr const char* kSheet =
      "\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, \"thin_walled\" on, "
      "\"refr_translucency\" on, \"refr_trans_weight\" 1, \"refr_trans_color\" .8 .4 .2";
  const Picture lit(plate(kSheet).light("sun", kSunBehind));
  expect_only(lit, {"tran_result"}, "sheet lit from behind");
  expect_near_color(lit.mean("tran_level"), Rgb(.8f, .4f, .2f), 1e-4f, "colour of the sheet");
  expect_near_color(lit.mean("tran_raw"), Rgb(1), 1e-4f, "light behind");
  const Picture sky(plate(kSheet).uniform_sky(2));
  expect_only(sky, {"tran_result"}, "sheet before a sky");
}

// acceptance: U2
TEST(Outputs, AddedColourPassesStraightThrough) {
  const Picture p(plate(std::string(kLambert) + ", \"additional_color\" .3 .2 .1"));
  expect_only(p, {"add_result"}, "glowing plate");
  expect_near_color(p.mean("add_result"), Rgb(.3f, .2f, .1f), 1e-6f, "the parameter");
}

TEST(Outputs, LightWithoutAMaterialIsOther) {
  SceneText scene;
  scene.uniform_sky(.7f).camera("focal 1 aperture .2 aspect 1 resolution 6 6");
  const Picture p(scene);
  expect_only(p, {"other"}, "sky");
  expect_near_color(p.mean("other"), Rgb(.7f), 1e-6f, "sky");
  expect_near_color(p.mean("opacity"), Rgb(1), 0, "no cut-out");
}

// acceptance: U2
TEST(Outputs, ReflectedLightIsReflectionForAnyLight) {
  // A mirror shows a lit, glossy, emissive wall: all of it is reflection.
  SceneText scene = plate("\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1");
  scene
      .material("wall",
                "\"reflectivity\" .5, \"refl_gloss\" .3, \"diffuse\" .8 .8 .8, "
                "\"additional_color\" .2 .2 .2, \"cutout_opacity\" .7")
      .square("wall", Vec3(0, 0, 2), 3, -kUp)
      .uniform_sky(.5f)
      .light("sun", kSunBehind);
  expect_only(Picture(scene), {"refl_result"}, "mirror before a wall");
}

// acceptance: U2, R9
TEST(Outputs, SpecularLevelIsThatOfReflectionTimesTheBalance) {
  for (const float balance : {1.0f, .25f, 3.0f, 0.0f})
    for (const char* more : {"", ", \"refl_base\" .6, \"refl_base_gloss\" .2",
                             ", \"refl_gloss_samples\" 0", ", \"refl_hl_only\" on"}) {
      const Picture p(plate(fmt::format("\"reflectivity\" .7, \"refl_color\" 1 .6 .3, "
                                        "\"refl_gloss\" .5, \"hl_vs_refl_balance\" {}{}",
                                        balance, more))
                          .light("sun", kSun)
                          .uniform_sky(.4f),
                      8);
      for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) {
          EXPECT_GT(p.at("refl_level", x, y).x, .1f);
          expect_near_color(p.at("spec_level", x, y), p.at("refl_level", x, y) * balance, 1e-6f,
                            more);
        }
    }
}

/// A square whose texture runs from one texel to the other.
std::string textured_plate(const std::string& options) {
  SceneText scene(options);
  scene.statement(
      "color texture \"two\" [2 1 1] 'fc33'\n"
      "shader \"place\" \"mib_texture_vector\" ( \"select\" 0 )\n"
      "shader \"look\" \"mib_texture_lookup\" ( \"tex\" \"two\", \"coord\" = \"place\" )\n");
  scene.material("m",
                 "\"reflectivity\" .3, \"brdf_0_degree_refl\" .5, \"refl_gloss\" .3, "
                 "\"diffuse\" = \"look\"");
  scene.statement(
      "object \"plate\" visible on shadow on trace on group\n"
      "-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  0 0 0  1 0 0  1 1 0  0 1 0\n"
      "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end object\n"
      "instance \"plate_i\" \"plate\" material \"m\" end instance\n");
  scene.light("sun", kSun).camera("focal 1 aperture 1 aspect 1 resolution 16 4");
  std::string text = scene.str();
  // The composed scene lists its own outputs.
  text.insert(text.find("\"cam_i\"", text.find("instgroup")), "\"plate_i\" ");
  return text;
}

// acceptance: U2
TEST(Outputs, RawLightIsFreeOfTextures) {
  const Picture p(textured_plate("trace depth 4 4 8"), 16);
  float least = 1e9f, most = 0;
  for (int x = 0; x < 16; ++x) {
    EXPECT_NEAR(p.at("diffuse_raw", x, 2).x, 1, 1e-4f) << x;
    const float level = p.at("diffuse_level", x, 2).x;
    EXPECT_NEAR(p.at("diffuse_result", x, 2).x, level, 1e-4f * level) << x;
    least = std::min(least, level);
    most = std::max(most, level);
  }
  EXPECT_GT(most, 2 * least) << "the texture is in the level";
}

// acceptance: U4
TEST(Outputs, SwitchedOffTheyLeaveTheLightToTheResult) {
  const std::string all =
      "\"reflectivity\" .5, \"refl_gloss\" .5, \"transparency\" .3, \"thin_walled\" on, "
      "\"refr_translucency\" on, \"additional_color\" .1 .1 .1, \"cutout_opacity\" .6, "
      "\"ao_on\" on";
  const auto picture = [&](const char* switched) {
    return Picture(plate(all + ", \"multiple_outputs\" " + switched)
                       .uniform_sky(.5f)
                       .light("sun", kSun)
                       .light("back", kSunBehind));
  };
  const Picture on = picture("on"), off = picture("off");
  EXPECT_EQ(on.layer("result").pixels, off.layer("result").pixels);
  EXPECT_EQ(off.layer("result").pixels, off.layer("other").pixels);
  expect_only(off, {"other"}, "multiple_outputs off");
  for (const char* name : {"diffuse_level", "refl_level", "refr_level", "tran_level", "spec_level"})
    EXPECT_EQ(off.mean(name), Rgb(0)) << name;
  expect_only(on,
              {"diffuse_result", "spec_result", "refl_result", "refr_result", "tran_result",
               "indirect_result", "add_result", "opacity_result"},
              "multiple_outputs on");
}

// acceptance: U5
TEST(Outputs, OpacityHasTheBackgroundScaledAndUnscaled) {
  for (const float opacity : {0.0f, .25f, .7f}) {
    const Picture p(plate(fmt::format("{}, \"cutout_opacity\" {}", kLambert, opacity))
                        .uniform_sky(2)
                        .light("sun", kSun),
                    256);
    expect_near_color(p.mean("opacity"), Rgb(opacity), 1e-6f, "opacity");
    expect_near_color(p.mean("opacity_result"), Rgb(2 * (1 - opacity)), .01f, "scaled");
    expect_near_color(p.mean("opacity_raw"), Rgb(2), .01f, "unscaled");
    expect_near_color(p.mean("diffuse_result"), Rgb(.5f * opacity), .02f, "light on what exists");
    if (opacity == 0) expect_only(p, {"opacity_result"}, "nothing there");
  }
}

// acceptance: U5
TEST(Outputs, OpacityIsBlackWhereAllIsOpaque) {
  const Picture p(plate(kLambert).uniform_sky(2), 16);
  EXPECT_EQ(p.mean("opacity_result"), Rgb(0));
  EXPECT_EQ(p.mean("opacity_raw"), Rgb(0));
  EXPECT_EQ(p.mean("opacity"), Rgb(1));
}

// acceptance: U2, O2
TEST(Outputs, OcclusionScalesRawIndirectLightToItsResult) {
  // A slab at .4 of the distance occludes .36; it is seen through by nothing, the sky is aside.
  for (const int details : {0, 1}) {
    SceneText scene = plate(
        fmt::format("\"reflectivity\" 0, \"diffuse\" .5 .5 .5, \"ao_on\" on, \"ao_do_details\" {}, "
                    "\"ao_distance\" 5, \"ao_dark\" .2 .2 .2",
                    details));
    scene.emitter("slab", 1).square("slab", Vec3(0, 0, 1), 200, -kUp);
    const Picture p(scene, 1024);
    const float free = 1 - .36f * .8f, open = details ? free : 1;
    expect_near_color(p.mean("ao_raw"), Rgb(free), .01f, "occlusion, whatever it acts on");
    expect_near_color(p.mean("indirect_raw"), Rgb(1), .01f, "before occlusion");
    expect_near_color(p.mean("indirect_post_ao"), Rgb(open), .01f, "after occlusion");
    expect_near_color(p.mean("indirect_result"), Rgb(.5f * open), .01f, "times the diffuse colour");
  }
}

// acceptance: B1
TEST(Outputs, BumpsMayTurnTheReflectionAlone) {
  // Tilted by 45 degrees the mirror shows the side; the diffuse component keeps facing the sun.
  for (const bool spared : {true, false}) {
    const Picture p(plate(fmt::format("\"reflectivity\" .5, \"brdf_0_degree_refl\" 1, "
                                      "\"brdf_90_degree_refl\" 1, \"diffuse\" 1 1 1, "
                                      "\"bump_mode\" 6, \"standard_bump\" .6 0 .8, "
                                      "\"no_diffuse_bump\" {}",
                                      spared ? "on" : "off"))
                        .light("sun", kSun),
                    8);
    expect_near_color(p.mean("diffuse_raw"), Rgb(spared ? 1 : .8f), 1e-3f,
                      "light on the diffuse part");
  }
}

// acceptance: U4
TEST(Outputs, SwitchingThemOffLeavesFewPathsTheSameRays) {
  const auto picture = [](const char* outputs) {
    SceneText scene;
    scene
        .lambert("m", .5f,
                 fmt::format("\"ao_on\" on, \"ao_samples\" 16, \"ao_distance\" 2, "
                             "\"multiple_outputs\" {}",
                             outputs))
        .square("m", Vec3(0, 0, -2), 3, kUp)
        .box("m", Vec3(-.3f, -.3f, -2), Vec3(.3f, .3f, -1.5f))
        .uniform_sky(1)
        .camera("focal 1 aperture 1 aspect 1 resolution 8 8");
    return Picture(scene, 4);
  };
  EXPECT_EQ(picture("on").layer("").pixels, picture("off").layer("").pixels);
}

}  // namespace outputs_test
}  // namespace oriel::testing
