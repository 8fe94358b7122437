// SPDX-License-Identifier: Apache-2.0
// Shadow modes and shadow shaders: order of calls, and transmittance.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "support/probe.h"
#include "transport/photon/photon_trace.h"
#include "transport/shadow.h"

namespace oriel::testing {
namespace shadow_modes_test {

/// "test_step": light x scale - less. Two of them do not commute.
struct TestStep {
  float scale, less;
};
constexpr ParamSpec kTestStepRows[] = {{ORIEL_PARAM(TestStep, scale), .fallback = {1}},
                                       {ORIEL_PARAM(TestStep, less)}};
/// Recorded calls, in order.
struct StepLog {
  std::mutex mutex;
  std::vector<float> heights;
  std::vector<RayKind> kinds;
  std::vector<int> lights;
};
StepLog& step_log() {
  static StepLog log;
  return log;
}
constexpr ShaderSpec kTestStep = {
    .name = "test_step",
    .library = "test",
    .apply = kApplyShadow,
    .params = kTestStepRows,
    .params_size = sizeof(TestStep),
    .material = {
        .shadow =
            [](const Call& call, const Rgb& light) {
              StepLog& log = step_log();
              const std::lock_guard lock(log.mutex);
              log.heights.push_back(call.point.position.z);
              log.kinds.push_back(call.point.ray_kind);
              log.lights.push_back(call.point.light);
              const auto& p = call.as<TestStep>();
              return light * p.scale - Rgb(p.less);
            },
        .may_transmit = [](const ShaderNode&) { return true; },
    },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestStep});
  return all;
}
Probe step_probe_of(const SceneText& scene) {
  step_log().heights.clear();
  step_log().kinds.clear();
  step_log().lights.clear();
  return Probe(scene.str(), registry());
}

const std::string kSun =
    "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1";
/// Glass that does not bend and halves light in each unit.
const std::string kGel =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1, "
    "\"refr_falloff_on\" on, \"refr_falloff_dist\" 1, \"refr_falloff_color_on\" on, "
    "\"refr_falloff_color\" .5 .5 .5";

SceneText in_mode(const std::string& mode) {
  return SceneText("trace depth 8 8 12 shadow " + mode);
}
/// A black surface whose shadow is filtered.
SceneText& add_filter(SceneText& scene, const std::string& name, const std::string& shadow,
                      const std::string& surface = "\"reflectivity\" 0, \"diffuse\" 0 0 0") {
  return scene.statement(fmt::format(
      "material \"{}\" \"mia_material_x\" ( {} ) shadow {} end material", name, surface, shadow));
}
/// A white card under the sun.
SceneText lit_card(const std::string& mode) {
  SceneText scene = in_mode(mode);
  scene.lambert("card", 1).square("card", Vec3(0), 5, kUp).light("sun", kSun);
  return scene;
}
// acceptance: H6
TEST(ShadowModes, OffLetsLightThroughEverything) {
  for (const auto& [mode, exact] :
       {std::pair("off", 1.0f), {"on", 0.0f}, {"sort", 0.0f}, {"segments", 0.0f}}) {
    SceneText scene = lit_card(mode);
    scene.lambert("wall", .5f).square("wall", Vec3(0, 0, 1), 5, kUp);
    add_filter(scene, "filter", "\"test_step\" ( \"scale\" .5 )");
    scene.square("filter", Vec3(0, 0, 2), 5, kUp);
    EXPECT_EQ(step_probe_of(scene).direct_only().onto(Vec3(0), kUp, 40, 64).mean.x, exact) << mode;
    // No calls if nothing has to be decided, or behind an opaque surface.
    EXPECT_TRUE(step_log().heights.empty()) << mode;
  }
}

// acceptance: H6
TEST(ShadowModes, ABlockerThatBecomesOpaqueEndsTheShadowRay) {
  for (const char* mode : {"on", "sort", "segments"}) {
    SceneText scene = lit_card(mode);
    add_filter(scene, "half", "\"test_step\" ( \"scale\" .5 )");
    add_filter(scene, "dark", "\"test_step\" ( \"scale\" 0 )");
    scene.square("half", Vec3(0, 0, 1), 5, kUp)
        .square("dark", Vec3(0, 0, 2), 5, kUp)
        .square("half", Vec3(0, 0, 3), 5, kUp);
    const Probe probe = step_probe_of(scene);
    RayCounts counts;
    ShadingPoint point;
    point.normal = point.geometric_normal = kUp;
    point.position = Vec3(0, 0, .5f);
    const Transmittance open = shadow_transmittance(
        probe.world(), point, kUp, std::numeric_limits<float>::infinity(), counts, 0);
    EXPECT_EQ(open.all, Rgb(0));
    EXPECT_EQ(step_log().heights, (std::vector<float>{1, 2})) << mode;
  }
}

// acceptance: H6
TEST(ShadowModes, SortAndSegmentsCallShadersFromPointToLight) {
  for (const char* mode : {"sort", "segments"})
    for (const bool half_first : {true, false}) {
      SceneText scene = lit_card(mode);
      add_filter(scene, "half", "\"test_step\" ( \"scale\" .5 )");
      add_filter(scene, "less", "\"test_step\" ( \"less\" .3 )");
      // In the order of the file the far one comes first.
      scene.square(half_first ? "less" : "half", Vec3(0, 0, 2), 5, kUp)
          .square(half_first ? "half" : "less", Vec3(0, 0, 1), 5, kUp);
      const Measured m = step_probe_of(scene).direct_only().onto(Vec3(0), kUp, 40, 64);
      expect_exact(fmt::format("shadow {}, {} first", mode, half_first ? "half" : "less"), m,
                   half_first ? .5f - .3f : (1 - .3f) * .5f);
      const StepLog& log = step_log();
      ASSERT_EQ(log.heights.size(), 2 * 64u);
      for (const RayKind kind : log.kinds) EXPECT_EQ(kind, RayKind::Shadow);
      for (const int light : log.lights) EXPECT_EQ(light, 0);
      EXPECT_EQ(std::count(log.heights.begin(), log.heights.end(), 1.0f), 64);
    }
}

// acceptance: H6, T8
TEST(ShadowModes, SegmentsDimTheLightThatShadersSeeByTheThicknessBefore) {
  for (const char* mode : {"on", "sort", "segments"})
    for (const bool glass_first : {true, false})
      for (const float thick : {.5f, 1.0f}) {
        SceneText scene = lit_card(mode);
        add_filter(scene, "less", "\"test_step\" ( \"less\" .3 )");
        scene.material("gel", kGel)
            .box("gel", Vec3(-5, -5, 2), Vec3(5, 5, 2 + thick))
            .square("less", Vec3(0, 0, glass_first ? 4 : 1), 5, kUp);
        const float kept = std::string_view(mode) == "segments" ? std::pow(.5f, thick) : 1;
        expect_exact(
            fmt::format("shadow {}, {} of glass {}", mode, thick, glass_first ? "first" : "last"),
            step_probe_of(scene).direct_only().onto(Vec3(0), kUp, 40, 64),
            glass_first ? kept - .3f : (1 - .3f) * kept);
      }
}

// acceptance: H6
TEST(ShadowShader, TransparencyFiltersByColourAndTransparencyAndAlpha) {
  const struct {
    const char* parameters;
    Rgb exact;
  } kCases[] = {
      {"\"color\" 1 1 1, \"transp\" 0 0 0", Rgb(0)},
      {"\"color\" 1 1 1, \"transp\" 1 1 1", Rgb(1)},
      {"\"color\" .9 .8 .7, \"transp\" .5 .25 1", Rgb(.45f, .2f, .7f)},
      {"\"color\" .9 .8 .7 0, \"transp\" 0 0 0", Rgb(.9f, .8f, .7f)},
      {"\"color\" 1 1 1 .5, \"transp\" 0 .5 1", Rgb(.5f, .75f, 1)},
      {"\"transp\" 1 1 1", Rgb(0)},
  };
  for (const char* mode : {"on", "sort", "segments"})
    for (const auto& c : kCases) {
      SceneText scene = lit_card(mode);
      add_filter(scene, "filter", fmt::format("\"mib_shadow_transparency\" ( {} )", c.parameters));
      scene.square("filter", Vec3(0, 0, 1), 5, kUp);
      expect_exact(fmt::format("shadow {}, {}", mode, c.parameters),
                   Probe(scene).direct_only().onto(Vec3(0), kUp, 40, 64), c.exact);
    }
}

TEST(ShadowShader, TransparencyAsksForItsLights) {
  const std::string green =
      "\"mib_light_infinite\" ( \"color\" 0 1 0, \"shadow\" on ) direction 0 0 -1";
  const struct {
    int mode;
    bool list;
    Rgb exact;  // the sun is white, the other light green
  } kCases[] = {{0, false, Rgb(.5f, 1, .5f)},   {0, true, Rgb(1, 1.5f, 1)},
                {1, true, Rgb(1, 1.5f, 1)},     {1, false, Rgb(1, 2, 1)},
                {2, true, Rgb(.5f, 1.5f, .5f)}, {4, true, Rgb(.5f, 1, .5f)}};
  for (const auto& c : kCases) {
    SceneText scene = lit_card("on");
    scene.light("green", green);
    add_filter(scene, "filter",
               fmt::format("\"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .5 .5 .5, "
                           "\"mode\" {}{} )",
                           c.mode, c.list ? ", \"lights\" [ \"green_i\" ]" : ""));
    scene.square("filter", Vec3(0, 0, 1), 5, kUp);
    expect_exact(fmt::format("mode {}, list {}", c.mode, c.list),
                 Probe(scene).direct_only().onto(Vec3(0), kUp, 40, 64), c.exact);
  }
}

// acceptance: T8
TEST(ShadowShader, MaterialsInTheSlotMeanTheirClosure) {
  const std::string pane =
      "\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, \"thin_walled\" on, "
      "\"refr_color\" .8 .6 .4";
  const std::string lambert = "\"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 )";
  const struct {
    const char* name;
    std::string surface, shadow;
    Rgb exact;
  } kCases[] = {
      {"none", "\"mia_material_x\" ( " + pane + " )", "", Rgb(0)},
      {"a call without arguments", "\"mia_material_x\" ( " + pane + " )",
       "shadow \"mia_material_x\" ( )", Rgb(.8f, .6f, .4f)},
      {"another material", lambert, "shadow \"mia_material_x\" ( " + pane + " )",
       Rgb(.8f, .6f, .4f)},
      {"an opaque material", "\"mia_material_x\" ( " + pane + " )", "shadow " + lambert, Rgb(0)},
      {"a filter on clear glass", "\"mia_material_x\" ( " + pane + " )",
       "shadow \"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .1 .2 .3 )",
       Rgb(.1f, .2f, .3f)},
      {"a filter and a material", lambert,
       "shadow \"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .1 .2 .3 ) "
       "\"mia_material_x\" ( " +
           pane + " )",
       Rgb(.08f, .12f, .12f)},
      {"two filters", lambert,
       "shadow \"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .1 .2 .3 ) "
       "\"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .5 .5 .5 )",
       Rgb(.05f, .1f, .15f)},
      {"a promise to be opaque", "opaque " + lambert,
       "shadow \"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .1 .2 .3 )", Rgb(0)},
  };
  for (const auto& c : kCases) {
    SceneText scene = lit_card("on");
    scene.statement(fmt::format("material \"m\" {} {} end material", c.surface, c.shadow))
        .square("m", Vec3(0, 0, 1), 5, kUp);
    expect_exact(c.name, Probe(scene).direct_only().onto(Vec3(0), kUp, 40, 64), c.exact);
  }
}

// acceptance: T8
TEST(ShadowShader, MediaInTheSlotAreAbsorbedByThickness) {
  for (const char* mode : {"on", "segments"}) {
    SceneText scene = lit_card(mode);
    scene
        .statement("material \"m\" \"mib_illum_lambert\" ( ) shadow \"mia_material_x\" ( " + kGel +
                   " ) end material")
        .box("m", Vec3(-5, -5, 1), Vec3(5, 5, 3));
    expect_exact(fmt::format("medium of the slot, shadow {}", mode),
                 Probe(scene).direct_only().onto(Vec3(0), kUp, 40, 64),
                 std::string_view(mode) == "segments" ? .25f : 1.0f);
  }
}

/// Filtered surface: emits .2 and returns nothing else, or has cut-outs.
const char* const kGlow = "\"reflectivity\" 0, \"diffuse\" 0 0 0, \"additional_color\" .2 .2 .2";
const char* const kFilter =
    "\"mib_shadow_transparency\" ( \"color\" 1 1 1, \"transp\" .5 .25 .75 )";

// acceptance: H6
TEST(ShadowShader, RaysAfterADiffuseBounceHaveTheTransmittanceOfShadowRays) {
  for (const bool lamp : {false, true})
    for (const float opacity : {1.0f, .5f})
      for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
        SceneText scene = in_mode("on");
        add_filter(scene, "filter", kFilter,
                   fmt::format("{}, \"cutout_opacity\" {}", kGlow, opacity));
        scene.lambert("card", 1)
            .square("card", Vec3(0), .5f, kUp)
            .square("filter", Vec3(0, 0, 1), 400, kUp);
        // A square of side 2, 2 above the card; or the whole sky.
        if (lamp)
          scene.light("lamp",
                      "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 2 "
                      "direction 0 0 -1 rectangle 2 0 0 0 2 0 4 4");
        else
          scene.uniform_sky(1);
        const auto seen = [&](const SceneText& text) {
          return Probe(text).estimator(e).onto(Vec3(0), kUp, 10, 1 << 16);
        };
        SceneText open = in_mode("on");
        open.lambert("card", 1).square("card", Vec3(0), .5f, kUp);
        if (lamp)
          open.light("lamp",
                     "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 2 "
                     "direction 0 0 -1 rectangle 2 0 0 0 2 0 4 4");
        const float light =
            lamp ? Probe(open).direct_only().onto(Vec3(0), kUp, 10, 1 << 16).mean.x : 1;
        expect_exact(fmt::format("{} through a filter of opacity {}, estimator {}",
                                 lamp ? "lamp" : "sky", opacity, static_cast<int>(e)),
                     seen(scene), Rgb(.5f, .25f, .75f) * light + Rgb(.2f * opacity), .02f);
      }
}

// acceptance: H6
TEST(ShadowShader, PhotonsHaveTheTransmittanceOfShadowRays) {
  // A box that lets light out: each photon that meets it passes, is scattered back, or is lost.
  for (const float albedo : {0.0f, .3f, .6f}) {
    SceneText scene = in_mode("on");
    add_filter(scene, "filter", kFilter,
               fmt::format("\"reflectivity\" 0, \"diffuse\" {0} {0} {0}", albedo));
    scene.box("filter", Vec3(-1), Vec3(1), true)
        .light("lamp", "\"physical_light\" ( \"color\" 10 10 10 ) origin 0 .2 .3");
    PhotonSettings settings{.depth = {200, 200, 200}};
    settings.each.global.emit = 1 << 17;
    PhotonBalance balance;
    RayCounts counts;
    const PhotonMaps maps = trace_photons(Probe(scene).world(), settings, counts, &balance);
    const Rgb exact = Rgb(.5f, .25f, .75f) * (1 / (1 - albedo));
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(balance.escaped[k] / balance.emitted[k], exact[k], .02 * exact[k]) << albedo;
      EXPECT_NEAR(balance.escaped[k] + balance.absorbed[k] + balance.stopped[k], balance.emitted[k],
                  1e-5 * balance.emitted[k]);
    }
    figure(fmt::format("photons out of a filter of albedo {}", albedo), exact.y,
           balance.escaped.y / balance.emitted.y, 0);
  }
}

// Manual 1.6.8.2: shadows show refr_falloff_dist in the mode "segments" only.
TEST(ShadowShader, PhotonsAreAbsorbedByMediaOfTheSlotAsShadowRaysAre) {
  for (const bool segments : {false, true}) {
    SceneText scene = in_mode(segments ? "segments" : "on");
    scene
        .statement("material \"m\" \"mib_illum_lambert\" ( ) shadow \"mia_material_x\" ( " + kGel +
                   " ) end material")
        .box("m", Vec3(-5, -5, 1), Vec3(5, 5, 3))
        .light("lamp",
               "\"physical_light\" ( \"color\" 1 1 1 ) origin 0 0 6 direction 0 0 -1 spread .999");
    PhotonSettings settings;
    settings.each.global.emit = 1 << 14;
    PhotonBalance balance;
    RayCounts counts;
    trace_photons(Probe(scene).world(), settings, counts, &balance);
    // Two units; photons end by chance instead of growing weak, and three deviations are .01.
    EXPECT_NEAR(balance.escaped.x / balance.emitted.x, segments ? .25 : 1, .01) << segments;
  }
}

TEST(ShadowShader, TransmittedLightIsDirectAndNotInMaps) {
  SceneText scene = in_mode("on");
  add_filter(scene, "filter", kFilter);
  scene.material("grey", "\"reflectivity\" 0, \"diffuse\" .5 .5 .5")
      .square("filter", Vec3(0, 0, 1), 3, kUp)
      .square("grey", Vec3(0), 3, kUp)
      .light("sun", kSun);
  PhotonSettings settings;
  settings.each.global.emit = settings.each.caustic.emit = 1 << 14;
  RayCounts counts;
  const PhotonMaps maps = trace_photons(Probe(scene).world(), settings, counts);
  EXPECT_TRUE(maps.caustic.empty());
  EXPECT_TRUE(maps.global.empty());
}

}  // namespace shadow_modes_test
}  // namespace oriel::testing
