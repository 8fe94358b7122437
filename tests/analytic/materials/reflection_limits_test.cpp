// SPDX-License-Identifier: Apache-2.0
// Limits of reflections by distance and depth, and highlights of lights at these limits.
#include <atomic>

#include "support/probe.h"

namespace oriel::testing {
namespace reflection_limits_test {

std::string metal(float gloss, const std::string& more = {}) {
  return fmt::format(
      "\"diffuse\" 1 1 1, \"refl_is_metal\" on, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
      "\"refl_depth\" 0, \"refl_gloss\" {}{}{}",
      gloss, more.empty() ? "" : ", ", more);
}

const std::string kFades = "\"refl_falloff_on\" on, \"refl_falloff_dist\" 2";
const std::string kToColour =
    kFades + ", \"refl_falloff_color_on\" on, \"refl_falloff_color\" .2 .5 1";
const Rgb kColour(.2f, .5f, 1);

Measured down_onto(Probe& probe, int samples = 64, float degrees = 0) {
  return probe.onto(Vec3(0), kUp, degrees, samples, .2f);
}

// acceptance: R6
TEST(ReflectionFalloff, FadesToItsColourOrTheEnvironmentByDistance) {
  for (const float height : {.5f, 1.0f, 1.5f, 1.999f, 2.001f, 5.0f})
    for (const bool colour : {true, false})
      for (const float gloss : {1.0f, .9f}) {
        SceneText scene;
        scene.uniform_sky(.25f)
            .material("m", metal(gloss, colour ? kToColour : kFades))
            .emitter("glow", 3)
            .plate("m")
            .square("glow", Vec3(0, 0, height), 50, -kUp);
        const float kept = std::max(0.0f, 1 - height / 2);
        Probe probe(scene);
        const Measured m = down_onto(probe, 4096);
        const Rgb exact = Rgb(3) * kept + (colour ? kColour : Rgb(.25f)) * (1 - kept);
        // A blurred ray is a little longer than the height.
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(m.mean[k] / exact[k], 1, gloss < 1 ? .002f : 2e-4f) << height << ' ' << gloss;
        figure(fmt::format("glow of 3 at {} of 2, fades to {}, gloss {}", height,
                           colour ? "colour" : "sky", gloss),
               exact.x, m.mean.x, m.error.x);
      }
  // Nothing at all within the distance.
  for (const bool colour : {true, false}) {
    SceneText scene;
    scene.uniform_sky(.25f).material("m", metal(1, colour ? kToColour : kFades));
    scene.plate("m");
    Probe probe(scene);
    expect_exact("nothing within the distance", down_onto(probe), colour ? kColour : Rgb(.25f));
  }
}

// acceptance: R6
TEST(ReflectionFalloff, RaysEndThere) {
  // A mirror above: met within the distance, it is followed on; beyond it, not.
  const auto rays = [](float height, const std::string& falloff) {
    SceneText scene("trace depth 6 6 6 shadow on");
    scene.uniform_sky(.25f)
        .material("m", metal(1, falloff))
        .material("above", metal(1))
        .plate("m")
        .square("above", Vec3(0, 0, height), 5, -kUp);
    Probe probe(scene);
    const Measured m = down_onto(probe);
    return m.each(m.counts.reflect);
  };
  EXPECT_EQ(rays(1, {}), 6);
  EXPECT_EQ(rays(1, kFades), 6);
  EXPECT_EQ(rays(2.5f, {}), 6);
  EXPECT_EQ(rays(2.5f, kFades), 1);
  EXPECT_EQ(rays(2.5f, kToColour), 1);
}

// acceptance: R6
TEST(ReflectionFalloff, ReflectedLightsFadeAndHighlightsDoNot) {
  const auto plate = [](const std::string& material, bool visible, Estimator e, float height) {
    SceneText scene;
    scene.material("m", material)
        .plate("m")
        .light("lamp",
               fmt::format("\"physical_light\" ( \"color\" 40 40 40 ) origin 0 0 {} "
                           "direction 0 0 -1 rectangle 2 0 0 0 2 0 3 3",
                           height),
               visible ? "visible on" : "");
    Probe probe(scene);
    return down_onto(probe.estimator(e), 1 << 15, 5);
  };
  for (const float gloss : {1.0f, .5f})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      if (gloss == 1 && e != Estimator::Mis) continue;
      const std::string name = fmt::format(", gloss {}, estimator {}", gloss, static_cast<int>(e));
      const Measured full = plate(metal(gloss), true, e, 1);
      const Measured faded = plate(metal(gloss, kFades), true, e, 1);
      EXPECT_GT(full.mean.x, .5f);
      // The way is 1 / cos 5 degrees and, blurred, a percent more.
      EXPECT_NEAR(faded.mean.x / full.mean.x, .498f, .006f) << name;
      figure("lamp at half distance against full" + name, .498, faded.mean.x / full.mean.x,
             std::hypot(faded.error.x, full.error.x) / full.mean.x);
      EXPECT_EQ(plate(metal(gloss, kFades), true, e, 2.2f).mean.x, 0) << name;
      if (gloss < 1)
        expect_same("highlight of an invisible lamp" + name,
                    plate(metal(gloss, kFades), false, e, 1), plate(metal(gloss), false, e, 1),
                    .04f);
    }
}

// acceptance: R6
TEST(ReflectionFalloff, FadesAlikeByAllEstimators) {
  SceneText scene;
  scene.environment("\"test_sky\" ( \"above\" .5 .7 1, \"below\" .3 .2 .1, \"up\" .5 .1 1 )")
      .material("m", metal(.1f, kFades))
      .lambert("wall", .5f)
      .emitter("glow", 3)
      .square("m", Vec3(0), 1, kUp)
      .square("glow", Vec3(-.6f, 0, .7f), .5f, -kUp)
      .square("wall", Vec3(1, 0, .5f), 1, Vec3(-1, 0, 0));
  Probe probe(scene);
  const auto measure = [&](Estimator e) {
    return probe.estimator(e).onto(Vec3(0), kUp, 20, 1 << 15, .3f);
  };
  const Measured both = measure(Estimator::Mis);
  expect_same("fading reflections, light samples", measure(Estimator::LightOnly), both, .01f);
  expect_same("fading reflections, lobes", measure(Estimator::BsdfOnly), both, .01f);
}

/// Between two mirrors of one half that glow by 1, under a sky of 8 that only rays of the scene's
/// depth can reach.
Measured between_mirrors(const std::string& trace_depth, int own) {
  SceneText scene(trace_depth + " shadow on");
  scene.uniform_sky(8)
      .material("m", fmt::format("\"diffuse_weight\" 0, \"reflectivity\" .5, "
                                 "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1, "
                                 "\"refl_cutoff\" 0, \"refl_depth\" {}, "
                                 "\"additional_color\" 1 1 1",
                                 own))
      .plate("m")
      .square("m", Vec3(0, 0, 1), 5, -kUp);
  return Probe(scene).onto(Vec3(0), kUp, 0, 64);
}

// acceptance: R7
TEST(ReflectionDepth, TwoMirrorsShowThatManyInterReflections) {
  for (const int own : {1, 2, 3, 5, 9}) {
    const Measured m = between_mirrors("trace depth 20 20 40", own);
    EXPECT_EQ(m.each(m.counts.reflect), own);
    EXPECT_EQ(m.counts.environment, 0u);
    expect_exact(fmt::format("two mirrors to depth {}", own), m, 2 - std::pow(.5f, own));
  }
  // 0 is the scene's, by reflections or by the sum; there the environment is returned.
  for (const char* depth : {"trace depth 4 20 40", "trace depth 20 20 4"}) {
    const Measured m = between_mirrors(depth, 0);
    EXPECT_EQ(m.each(m.counts.reflect), 4);
    EXPECT_EQ(m.each(m.counts.environment), 1);
    expect_exact("two mirrors to the depth of the scene", m,
                 2 - std::pow(.5f, 4) + 8 * std::pow(.5f, 5));
  }
  // A material does not reach deeper than the scene.
  const Measured m = between_mirrors("trace depth 4 20 40", 9);
  EXPECT_EQ(m.each(m.counts.reflect), 4);
}

// acceptance: R7
TEST(ReflectionDepth, AtTheLimitHighlightsStay) {
  // A mirror shows a blurred plate that is at its depth then.
  const auto plate = [](const std::string& limit, const std::string& lamp, const char* flags) {
    SceneText scene;
    scene.material("mirror", metal(1))
        .material("plate", metal(.4f, limit))
        .square("mirror", Vec3(0), .05f, kUp)
        .square("plate", Vec3(0, 0, 1), .5f, -kUp)
        .light("lamp", lamp, flags);
    const float a = 20 * kPi / 180;
    const Vec3 d(-std::sin(a), 0, -std::cos(a));
    return Probe(scene).ray(d * -.2f, d, 1 << 14);
  };
  const std::string spark = "\"mib_light_point\" ( \"color\" 1 1 1 ) origin -.7 0 .2";
  const std::string area =
      "\"physical_light\" ( \"color\" 9 9 9 ) origin -.7 0 .2 direction 0 0 1 "
      "rectangle .4 0 0 0 .4 0 3 3";
  struct Lamp {
    const char* name;
    std::string text;
    const char* flags;
  };
  for (const Lamp& lamp : {Lamp{"point", spark, ""}, Lamp{"invisible area", area, ""},
                           Lamp{"visible area", area, "visible on"}}) {
    const Measured free = plate("\"refl_depth\" 0", lamp.text, lamp.flags);
    const Measured deep = plate("\"refl_depth\" 1", lamp.text, lamp.flags);
    const Measured only = plate("\"refl_hl_only\" on", lamp.text, lamp.flags);
    EXPECT_GT(free.each(free.counts.reflect), 1.9);
    EXPECT_EQ(deep.each(deep.counts.reflect), 1);
    EXPECT_GT(deep.mean.x, .05f) << lamp.name;
    expect_same(fmt::format("highlight at the depth, {} light", lamp.name), deep, free, .02f);
    expect_same(fmt::format("depth against highlights only, {} light", lamp.name), deep, only,
                .02f);
  }
}

/// "test_asked": white, and counts its calls.
std::atomic<int> times_asked{0};
constexpr ShaderSpec kTestAsked = {
    .name = "test_asked",
    .library = "test",
    .apply = kApplyTexture,
    .value =
        [](const Call&, void* result) {
          ++times_asked;
          *static_cast<Rgba*>(result) = Rgba(1, 1, 1, 1);
        },
};

// acceptance: R6
TEST(ReflectionFalloff, SurfacesBeyondAreNotReached) {
  const Registry registry = test_registry_with({&kTestAsked});
  const auto asked = [&](float height, const std::string& falloff) {
    SceneText scene;
    scene.material("m", metal(1, falloff))
        .statement("shader \"asked\" \"test_asked\" ()")
        .material("far",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"asked\"")
        .plate("m")
        .square("far", Vec3(0, 0, height), 5, -kUp);
    Probe probe(scene.str(), registry);
    times_asked = 0;
    down_onto(probe);
    return times_asked.load();
  };
  EXPECT_EQ(asked(1.9f, kFades), 64);
  EXPECT_EQ(asked(2.1f, kFades), 0);
  EXPECT_EQ(asked(2.1f, kToColour), 0);
  EXPECT_EQ(asked(2.1f, {}), 64);
}

/// A plate under a square light, split into reflection and highlight.
Measured told_apart(const std::string& material, bool visible, Estimator e = Estimator::Mis) {
  SceneText scene;
  scene.material("m", material)
      .plate("m")
      .light("lamp",
             "\"physical_light\" ( \"color\" 40 40 40 ) origin .6 0 1 direction 0 0 -1 "
             "rectangle 1 0 0 0 1 0 3 3",
             visible ? "visible on" : "");
  Probe probe(scene);
  return probe.estimator(e).outputs().ray(Vec3(-.3f, 0, .5f), Vec3(.3f, 0, -.5f), 1 << 15);
}

// acceptance: R10
TEST(Highlight, OutputsContainReflectionOrHighlightAndBothOnRequest) {
  for (const float gloss : {.1f, .4f})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      Measured seen = told_apart(metal(gloss), true, e);
      Measured hidden = told_apart(metal(gloss), false, e);
      Measured both = told_apart(metal(gloss, "\"no_visible_area_hl\" off"), true, e);
      const std::string name = fmt::format("gloss {}, estimator {}", gloss, static_cast<int>(e));
      const float one = seen.mean.x;
      EXPECT_GT(one, .2f);
      EXPECT_EQ(seen.outputs[Aov::Specular].x, 0) << name;
      EXPECT_NEAR(seen.outputs[Aov::Reflection].x / one, 1, .0001f) << name;
      EXPECT_EQ(hidden.outputs[Aov::Reflection].x, 0) << name;
      EXPECT_NEAR(hidden.outputs[Aov::Specular].x / one, 1, .01f) << name;
      EXPECT_NEAR(both.outputs[Aov::Reflection].x / one, 1, .01f) << name;
      EXPECT_NEAR(both.outputs[Aov::Specular].x / one, 1, .01f) << name;
      EXPECT_NEAR(both.mean.x / one, 2, .02f) << name;
      figure("reflection + highlight over one of them, " + name, 2, both.mean.x / one,
             std::hypot(both.error.x, 2 * seen.error.x) / one);
    }
}

// acceptance: R9
TEST(Highlight, FollowsLevelCurveAndAnisotropyOfReflections) {
  const auto plastic = [](float anisotropy, float rotation, const char* more) {
    return fmt::format(
        "\"diffuse_weight\" 0, \"reflectivity\" .7, \"refl_color\" 1 .6 .3, "
        "\"brdf_0_degree_refl\" .3, \"brdf_90_degree_refl\" .9, \"brdf_curve\" 1.5, "
        "\"refl_gloss\" .1, \"anisotropy\" {}, \"anisotropy_rotation\" {}{}",
        anisotropy, rotation, more);
  };
  for (const auto& [anisotropy, rotation] :
       {std::pair{1.0f, 0.0f}, std::pair{6.0f, 0.0f}, std::pair{6.0f, .25f}, std::pair{.2f, .1f}}) {
    const std::string name = fmt::format(", anisotropy {} turned by {}", anisotropy, rotation);
    const Measured rays = told_apart(plastic(anisotropy, rotation, ""), true, Estimator::BsdfOnly);
    const Measured only = told_apart(plastic(anisotropy, rotation, ", \"refl_hl_only\" on"), false);
    expect_same("highlight against rays" + name, only, rays, .015f);
    EXPECT_GT(rays.mean.x, .05f);
  }
}

}  // namespace reflection_limits_test
}  // namespace oriel::testing
