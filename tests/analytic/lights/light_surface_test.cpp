// SPDX-License-Identifier: Apache-2.0
// Visible part of lights, and lights without highlights or diffuse light.
#include <fstream>

#include "support/probe.h"

namespace oriel::testing {
namespace light_surface_test {

/// What a ray of that kind sees of material "m" at a place.
Rgb seen(const Probe& probe, const Vec3& place, RayKind kind = RayKind::Eye) {
  for (const Material& m : probe.world().materials) {
    if (m.name != "m") continue;
    ShadingPoint point;
    point.position = place;
    point.ray_kind = kind;
    point.world = &probe.world();
    Closure closure;
    shade(m, point, closure);
    return closure.emission;
  }
  return Rgb(-1);
}

/// A light of 50 cd, directed downward, in an instance moved to (1, 2, 3).
SceneText lamp_scene(const std::string& parameters) {
  const std::string path = ::testing::TempDir() + "/oriel-down.ies";
  std::ofstream(path) << "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 40\n0 90\n0\n50 50\n";
  SceneText scene;
  scene
      .statement(fmt::format("lightprofile \"lp\" file \"{}\" end lightprofile\n"
                             "material \"m\" \"mia_light_surface\" ( {} ) end material",
                             path, parameters))
      .light("lamp",
             "\"mib_light_photometric\" ( \"color\" 1 .5 0, \"shadow\" on, \"profile\" \"lp\" ) "
             "origin 0 0 0",
             "transform 1 0 0 0  0 1 0 0  0 0 1 0  -1 -2 -3 1")
      .plate("m");
  return scene;
}
const std::string kLights = "\"use_lights\" on, \"lights\" [ \"lamp_i\" ], ";
const Vec3 kLamp(1, 2, 3);

void expect_rgb(const Rgb& c, const Vec3& exact) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], exact[k], 1e-3 * exact[k] + 1e-6);
}

// acceptance: G1
TEST(LightSurface, ItShowsColourTimesLightsAndIntensity) {
  expect_rgb(seen(Probe(lamp_scene("\"color\" 1 2 3, \"intensity\" 4")), Vec3(0)), Vec3(4, 8, 12));
  // Half a metre below: 50 cd / .25 m2 = 200 lx, a white surface shows 200 / pi.
  const Probe both(lamp_scene(kLights + "\"color\" 1 2 3, \"intensity\" 4, "
                                        "\"lights_multiplier\" .5"));
  const Vec3 below = kLamp - Vec3(0, 0, .5f);
  const float l = 200 / kPi;
  expect_rgb(seen(both, below), Vec3(.5f * l + 4, 2 * (.25f * l + 4), 12));
  // The list alone does nothing.
  const Probe off(lamp_scene("\"lights\" [ \"lamp_i\" ], \"intensity\" 4"));
  expect_rgb(seen(off, below), Vec3(4, 4, 4));
}

// acceptance: G2
TEST(LightSurface, GatherAndReflectionRaysSeeTheirShares) {
  const Probe probe(lamp_scene("\"intensity\" 4, \"fg_contrib\" .25, \"refl_contrib\" .5"));
  expect_rgb(seen(probe, Vec3(0), RayKind::Eye), Vec3(4));
  expect_rgb(seen(probe, Vec3(0), RayKind::Refract), Vec3(4));
  expect_rgb(seen(probe, Vec3(0), RayKind::FinalGather), Vec3(1));
  expect_rgb(seen(probe, Vec3(0), RayKind::Reflect), Vec3(2));
  // In images: a wide emissive ceiling over a white floor and over a mirror.
  for (const float share : {0.0f, .5f, 1.0f}) {
    SceneText scene;
    scene
        .statement(fmt::format("shader \"g\" \"mia_light_surface\" ( \"intensity\" 2, "
                               "\"fg_contrib\" {0}, \"refl_contrib\" {0} )",
                               share))
        .material("ceiling",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"g\"")
        .lambert("white", 1)
        .material("mirror",
                  "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_fresnel\" off, "
                  "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1")
        .square("ceiling", Vec3(0, 0, 1), 200, -kUp)
        .square("white", Vec3(0), .4f, kUp)
        .square("mirror", Vec3(2, 0, 0), .4f, kUp);
    const Probe room(scene);
    EXPECT_NEAR(room.onto(Vec3(0), kUp).mean.x, 2 * share, .01 + .02 * share);
    EXPECT_NEAR(room.onto(Vec3(2, 0, 0), kUp).mean.x, 2 * share, 1e-3);
    EXPECT_NEAR(room.ray(Vec3(0, 0, .5f), kUp, 16).mean.x, 2, 1e-3);
  }
}

// acceptance: G3
TEST(LightSurface, EvaluationPointMakesEmissionUniform) {
  const float radius = .1f;
  // At the shaded point: the upper half is dark, because the light is directed downward.
  const Probe here(lamp_scene(kLights + "\"intensity\" 0"));
  const float bright = 50 / sqr(radius) / kPi;
  expect_rgb(seen(here, kLamp - Vec3(0, 0, radius)), Vec3(bright, bright / 2, 0));
  expect_rgb(seen(here, kLamp + Vec3(0, 0, radius)), Vec3(0));
  // In the light's own space, a metre below it.
  const Probe there(lamp_scene(kLights + "\"intensity\" 0, \"lights_eval_point\" 0 0 -1"));
  for (const Vec3& on : {Vec3(0, 0, radius), Vec3(0, 0, -radius), Vec3(radius, 0, 0)})
    expect_rgb(seen(there, kLamp + on), Vec3(50 / kPi, 25 / kPi, 0));
  // Nothing between matters: shadows are off.
  SceneText blocked = lamp_scene(kLights + "\"intensity\" 0, \"lights_eval_point\" 0 0 -1");
  blocked.lambert("grey", .5f).square("grey", kLamp - Vec3(0, 0, .5f), 1, kUp);
  expect_rgb(seen(Probe(blocked), Vec3(0)), Vec3(50 / kPi, 25 / kPi, 0));
}

struct Flags {
  float diffuse, specular;
};
constexpr ParamSpec kFlagRows[] = {{ORIEL_PARAM(Flags, diffuse), .fallback = {1}},
                                   {ORIEL_PARAM(Flags, specular), .fallback = {1}}};
constexpr ShaderSpec kFlagLight = {.name = "flag_light",
                                   .library = "test",
                                   .apply = kApplyLight,
                                   .params = kFlagRows,
                                   .params_size = sizeof(Flags),
                                   .light = {
                                       .evaluate =
                                           [](const Call& call, const LightCall&) {
                                             const Flags& f = call.as<Flags>();
                                             return LightValue{.colour = Rgb(1),
                                                               .affects_diffuse = f.diffuse,
                                                               .affects_specular = f.specular};
                                           },
                                   }};

const Registry& flag_registry() {
  static const Registry all = test_registry_with({&kFlagLight});
  return all;
}

/// Diffuse light and highlights of a glossy floor.
std::pair<float, float> split(const std::string& flags, const std::string& shape,
                              const std::string& instance = "",
                              const std::string& shader = "flag_light") {
  SceneText scene;
  scene
      .material("floor",
                "\"diffuse\" .5 .5 .5, \"reflectivity\" .5, \"refl_gloss\" .5, "
                "\"brdf_fresnel\" off, \"brdf_0_degree_refl\" .5")
      .square("floor", Vec3(0), 3, kUp)
      .light("lamp", fmt::format("\"{}\" ( {} ) origin 0 0 2 {}", shader, flags, shape), instance);
  Probe probe(scene.str(), flag_registry());
  const Measured m = probe.outputs().onto(Vec3(0), kUp, 0, 1 << 14);
  const auto of = [&](Aov c) { return m.outputs.result[static_cast<std::size_t>(c)].x; };
  return {of(Aov::Diffuse), of(Aov::Specular) + of(Aov::Reflection)};
}

// acceptance: G4
TEST(LightFlags, LightsLeaveOutDiffuseLightOrHighlights) {
  const std::string rectangle = "direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3";
  for (const auto& [shape, instance] :
       {std::pair<std::string, std::string>("", ""), {rectangle, ""}, {rectangle, "visible on"}}) {
    const auto [diffuse, specular] = split("", shape, instance);
    ASSERT_GT(diffuse, .1f);
    ASSERT_GT(specular, .01f);
    const auto quiet = split("\"specular\" 0", shape, instance);
    EXPECT_NEAR(quiet.first, diffuse, .02f * diffuse);
    EXPECT_EQ(quiet.second, 0);
    const auto glint = split("\"diffuse\" 0", shape, instance);
    EXPECT_EQ(glint.first, 0);
    EXPECT_NEAR(glint.second, specular, .03f * specular);
    const auto half = split("\"diffuse\" .5, \"specular\" .25", shape, instance);
    EXPECT_NEAR(half.first, .5f * diffuse, .01f * diffuse);
    EXPECT_NEAR(half.second, .25f * specular, .01f * specular);
  }
}

// acceptance: G4
TEST(LightFlags, LightsOfOtherProgramsHaveThem) {
  for (const auto& [shader, diffuse_flag, specular_flag] :
       {std::array{"maya_pointlight", "emitDiffuse", "emitSpecular"},
        std::array{"maya_arealight", "emitDiffuse", "emitSpecular"},
        std::array{"max_OmniLight", "AffectDiffuse", "AffectSpecular"}}) {
    const std::string shape = std::string_view(shader) == "maya_arealight"
                                  ? "direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3"
                                  : "";
    const auto with = [&](const std::string& flags) { return split(flags, shape, "", shader); };
    const auto whole = with("");
    ASSERT_GT(whole.first, .01f) << shader;
    ASSERT_GT(whole.second, .001f) << shader;
    const auto quiet = with(fmt::format("\"{}\" off", specular_flag));
    EXPECT_NEAR(quiet.first, whole.first, .02f * whole.first) << shader;
    EXPECT_EQ(quiet.second, 0) << shader;
    const auto glint = with(fmt::format("\"{}\" off", diffuse_flag));
    EXPECT_EQ(glint.first, 0) << shader;
    EXPECT_NEAR(glint.second, whole.second, .03f * whole.second) << shader;
  }
}

}  // namespace light_surface_test
}  // namespace oriel::testing
