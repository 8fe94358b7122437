// SPDX-License-Identifier: Apache-2.0
// Number of rays of a material; the image is the same for any number.
#include <functional>

#include "support/probe.h"

namespace oriel::testing {
namespace ray_count_test {

/// Reflects this fraction for all angles, and nothing else.
std::string reflecting(float level, const std::string& more = {}) {
  return fmt::format(
      "\"diffuse_weight\" 0, \"reflectivity\" {}, \"brdf_0_degree_refl\" 1, "
      "\"brdf_90_degree_refl\" 1, \"refl_depth\" 0{}{}",
      level, more.empty() ? "" : ", ", more);
}
/// A sheet that passes that share, and nothing else.
std::string passing(float level, const std::string& more = {}) {
  return fmt::format(
      "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" {}, \"thin_walled\" on, "
      "\"refr_depth\" 0{}{}",
      level, more.empty() ? "" : ", ", more);
}

/// Onto a plate under an even sky. Lobes of gloss .9 lose none of these rays below its horizon.
Measured plate(const std::string& material, float paths, int samples = 64) {
  SceneText scene;
  scene.uniform_sky(1).material("m", material).plate("m");
  return Probe(scene).paths_of_pixel(paths).onto(Vec3(0), kUp, 0, samples);
}

// acceptance: R3
TEST(SampleCounts, AreTheMaximumRaysPerPixelAndFallWithTheLevel) {
  for (const int count : {1, 8, 30, 128}) {
    const auto glossy = [&](float level, float paths) {
      const Measured m = plate(
          reflecting(level, fmt::format("\"refl_gloss\" .9, \"refl_gloss_samples\" {}", count)),
          paths);
      return m.each(m.counts.reflect);
    };
    const auto rough = [&](float level, float paths) {
      const Measured m =
          plate(passing(level, fmt::format("\"refr_gloss\" .9, \"refr_gloss_samples\" {}", count)),
                paths);
      return m.each(m.counts.refract);
    };
    for (const auto& rays : {std::function<double(float, float)>(glossy), {rough}}) {
      EXPECT_EQ(rays(1, 1), count);
      double before = count;
      for (const float level : {.9f, .5f, .25f, .1f, .02f}) {
        // A share of a ray is a whole one.
        EXPECT_EQ(rays(level, 1), std::ceil(double(level) * count - 1e-3)) << level;
        EXPECT_LE(rays(level, 1), before);
        before = rays(level, 1);
      }
      for (const float paths : {2.0f, 4.0f, 16.0f, 1000.0f}) {
        EXPECT_EQ(rays(1, paths), std::max(1.0, std::ceil(double(count) / paths - 1e-3))) << paths;
        EXPECT_LE(rays(1, paths) * paths, std::max<double>(paths, count + paths));
      }
    }
  }
}

// acceptance: R1, R2
TEST(SampleCounts, DoNotMultiplyPerfectMirrors) {
  for (const char* more : {"\"refl_gloss\" 1, \"refl_gloss_samples\" 128",
                           "\"refl_gloss\" .3, \"refl_gloss_samples\" 0"}) {
    const Measured m = plate(reflecting(1, more), 1);
    EXPECT_EQ(m.counts.reflect, 64u) << more;
  }
  for (const char* more : {"\"refr_gloss\" 1, \"refr_gloss_samples\" 128",
                           "\"refr_gloss\" .3, \"refr_gloss_samples\" 0"}) {
    const Measured m = plate(passing(1, more), 1);
    EXPECT_EQ(m.counts.refract, 64u) << more;
  }
}

// acceptance: R3
TEST(SampleCounts, CountAtTheFirstSurfaceOnly) {
  // Two glossy plates that face each other: the second surface gives each ray one more.
  SceneText scene("trace depth 2 2 2 shadow on");
  scene.uniform_sky(1)
      .material("m", reflecting(1, "\"refl_gloss\" .6, \"refl_gloss_samples\" 16"))
      .square("m", Vec3(0), 50, kUp)
      .square("m", Vec3(0, 0, 1), 50, -kUp);
  const Measured m = Probe(scene).paths_of_pixel(1).onto(Vec3(0), kUp, 5, 256);
  EXPECT_NEAR(m.each(m.counts.reflect), 32, .1);
}

// acceptance: R3
TEST(SampleCounts, OcclusionRaysAreThoseOfThePixelToo) {
  for (const int count : {1, 16, 40})
    for (const float paths : {1.0f, 4.0f, 64.0f}) {
      const Measured m = plate(
          fmt::format("\"reflectivity\" 0, \"ao_on\" on, \"ao_samples\" {}, \"ao_distance\" 2, "
                      "\"ao_ambient\" .5 .5 .5",
                      count),
          paths);
      EXPECT_EQ(m.each(m.counts.probe), std::max(1.0, std::ceil(double(count) / paths - 1e-3)));
    }
}

/// A sheet with all lobes between a light, a sky, an emitter above and one below.
SceneText crossroads() {
  SceneText scene;
  scene.environment("\"test_sky\" ( \"above\" .5 .7 1, \"below\" .3 .2 .1, \"up\" .3 .1 1 )")
      .material("sheet",
                "\"diffuse\" .8 .6 .4, \"reflectivity\" .5, \"refl_gloss\" .15, "
                "\"refl_gloss_samples\" 48, \"brdf_0_degree_refl\" .6, \"transparency\" .5, "
                "\"refr_gloss\" .2, \"refr_gloss_samples\" 40, \"thin_walled\" on, "
                "\"refr_translucency\" on, \"refr_trans_weight\" .3, \"ao_on\" on, "
                "\"ao_samples\" 8, \"ao_distance\" 1.5, \"ao_ambient\" .2 .2 .2")
      .emitter("glow", 3)
      .lambert("wall", .5f)
      .square("sheet", Vec3(0), .5f, kUp)
      .square("glow", Vec3(-.4f, 0, 1), .3f, -kUp)
      .square("glow", Vec3(.3f, .2f, -.8f), .3f, kUp)
      .square("wall", Vec3(1, 0, .5f), 1, Vec3(-1, 0, 0))
      .light("lamp",
             "\"physical_light\" ( \"color\" 4 4 4 ) origin 0 .6 1.5 direction 0 0 -1 "
             "rectangle .5 0 0 0 .5 0 3 3");
  return scene;
}

// acceptance: R3
TEST(SampleCounts, ChangeNothingInThePicture) {
  Probe probe(crossroads());
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
    probe.estimator(e);
    const Measured split = probe.paths_of_pixel(1).onto(Vec3(0), kUp, 35, 1 << 13, .3f);
    const Measured some = probe.paths_of_pixel(4).onto(Vec3(0), kUp, 35, 1 << 14, .3f);
    const Measured whole = probe.paths_of_pixel(1e6f).onto(Vec3(0), kUp, 35, 1 << 17, .3f);
    EXPECT_GT(split.each(split.counts.reflect), 3 * whole.each(whole.counts.reflect));
    const std::string name = fmt::format(", estimator {}", static_cast<int>(e));
    expect_same("split paths against whole ones" + name, split, whole, .015f);
    expect_same("four paths a pixel against whole ones" + name, some, whole, .015f);
  }
}

// acceptance: R8
TEST(CutOff, TracesWhatContributesMoreAndNothingElse) {
  for (const float level : {.099f, .101f}) {
    const bool traced = level > .1f;
    for (const char* gloss : {"1", ".9"}) {
      const Measured reflected = plate(
          reflecting(level, fmt::format("\"refl_gloss\" {}, \"refl_cutoff\" .1", gloss)), 1e6f);
      EXPECT_EQ(reflected.counts.reflect, traced ? 64u : 0u) << level;
      // The table of albedos is within a thousandth.
      EXPECT_NEAR(reflected.mean.x, traced ? level : 0, 1e-3f * level + 4 * reflected.error.x);
      const Measured passed =
          plate(passing(level, fmt::format("\"refr_gloss\" {}, \"refr_cutoff\" .1", gloss)), 1e6f);
      EXPECT_EQ(passed.counts.refract, traced ? 64u : 0u) << level;
    }
  }
  // Default: one percent.
  EXPECT_EQ(plate(reflecting(.0099f), 1e6f).counts.reflect, 0u);
  EXPECT_EQ(plate(reflecting(.0101f), 1e6f).counts.reflect, 64u);
  EXPECT_EQ(plate(passing(.0099f), 1e6f).counts.refract, 0u);
  EXPECT_EQ(plate(passing(.0101f), 1e6f).counts.refract, 64u);
}

// acceptance: R8
TEST(CutOff, UsesTheThroughputOfThePixel) {
  const auto bounces = [](float level, float cutoff) {
    SceneText scene("trace depth 20 20 20 shadow on");
    scene.material("m", reflecting(level, fmt::format("\"refl_cutoff\" {}", cutoff)))
        .plate("m")
        .square("m", Vec3(0, 0, 1), 5, -kUp);
    const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 64);
    return m.each(m.counts.reflect);
  };
  // The largest n with level^n >= cutoff.
  EXPECT_EQ(bounces(.3f, .1f), 1);   // .3, .09
  EXPECT_EQ(bounces(.32f, .1f), 2);  // .32, .1024, .0328
  EXPECT_EQ(bounces(.5f, .1f), 3);
  EXPECT_EQ(bounces(.5f, .01f), 6);
  EXPECT_EQ(bounces(.5f, 0), 20);
  const auto sheets = [](float level, float cutoff) {
    SceneText scene("trace depth 20 20 20 shadow on");
    scene.material("m", passing(level, fmt::format("\"refr_cutoff\" {}", cutoff)));
    for (int i = 0; i < 8; ++i) scene.square("m", Vec3(0, 0, -.1f * static_cast<float>(i)), 5, kUp);
    const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 64);
    return m.each(m.counts.refract);
  };
  EXPECT_EQ(sheets(.3f, .1f), 1);
  EXPECT_EQ(sheets(.32f, .1f), 2);
  EXPECT_EQ(sheets(.5f, .01f), 6);
  EXPECT_EQ(sheets(.5f, 0), 8);
}

// acceptance: R8
TEST(CutOff, DoesNotAffectDiffuseBounces) {
  // A card under a weak mirror that faces an emitter below the plane of the card.
  const auto light = [](float cutoff) {
    SceneText scene;
    scene.material("m", reflecting(.05f, fmt::format("\"refl_cutoff\" {}", cutoff)))
        .lambert("card", .04f)
        .emitter("glow", 10)
        .square("card", Vec3(0), .05f, kUp)
        .square("m", Vec3(0, 0, 1), 300, -kUp)
        .square("glow", Vec3(0, 0, -.5f), 300, kUp);
    return Probe(scene).onto(Vec3(0), kUp, 0, 1 << 14, .1f);
  };
  const Measured never = light(0), always = light(1);
  EXPECT_EQ(always.counts.reflect, never.counts.reflect);
  EXPECT_GT(always.each(always.counts.reflect), .5);
  expect_same("a glow in a weak mirror on a card, all cut off", always, never, .01f);
  EXPECT_GT(always.mean.x, .01f);
}

// acceptance: R5
TEST(HighlightsOnly, TracesNoReflectionRaysAndCostsAsMuchAsNone) {
  const auto scene = [](const std::string& reflection) {
    SceneText s;
    s.uniform_sky(.3f)
        .material("m", "\"diffuse\" .7 .7 .7, \"refl_gloss\" .3, " + reflection)
        .lambert("wall", .6f)
        .square("m", Vec3(0), 1, kUp)
        .sphere("m", Vec3(.3f, .2f, .3f), .25f, 24)
        .square("wall", Vec3(1, 0, 1), 1, Vec3(-1, 0, 0))
        .light("spark", "\"mib_light_point\" ( \"color\" .5 .5 .5 ) origin -.4 0 1")
        .camera("focal 1 aperture 1 aspect 1 resolution 16 16",
                "1 0 0 0  0 .7071068 -.7071068 0  0 .7071068 .7071068 0  0 0 -2 1");
    return s;
  };
  const Measured none = Probe(scene("\"reflectivity\" 0")).picture(1 << 16);
  const Measured full = Probe(scene("\"reflectivity\" .6")).picture(1 << 16);
  const Measured only = Probe(scene("\"reflectivity\" .6, \"refl_hl_only\" on")).picture(1 << 16);
  EXPECT_GT(full.counts.reflect, 1000u);
  EXPECT_EQ(only.counts.reflect, 0u);
  EXPECT_LE(double(only.counts.rays()), 1.05 * double(none.counts.rays()));
  figure("rays of highlights only against no reflection", 1,
         double(only.counts.rays()) / double(none.counts.rays()), 0);
  // The highlight itself is there: .5 at distance 1, in the mirror direction of the point light.
  const auto spark = [](const char* more) {
    SceneText s;
    s.material("m", reflecting(.5f, fmt::format("\"refl_gloss\" .3{}", more)))
        .plate("m")
        .light("spark", "\"mib_light_point\" ( \"color\" .5 .5 .5 ) origin .2 0 1");
    return Probe(s).direct_only().ray(Vec3(-.1f, 0, .5f), Vec3(.1f, 0, -.5f), 64);
  };
  const Measured lit = spark(", \"refl_hl_only\" on");
  EXPECT_EQ(lit.counts.reflect, 0u);
  EXPECT_GT(lit.mean.x, .1f);
  expect_same("a highlight alone", lit, spark(""));
}

// acceptance: R11
TEST(SingleEnvironmentSample, LooksUpTheMirrorsDirectionOnceForAllRays) {
  const Frame frame(kUp);
  const float a = 30 * kPi / 180;
  const Vec3 mirrored = frame.n * std::cos(a) - frame.s * std::sin(a);
  const Vec3 across = frame.n * std::sin(a) + frame.s * std::cos(a);
  for (const float off : {.1f, -.1f})  // degrees by which the mirrored view misses the edge
    for (const float paths : {1.0f, 1e6f}) {
      const auto measure = [&](const char* single) {
        SceneText scene;
        const float o = off * kPi / 180;
        scene.half_sky(1, across * std::cos(o) + mirrored * std::sin(o))
            .material("m", reflecting(1, fmt::format("\"refl_gloss\" .9, "
                                                     "\"refl_gloss_samples\" 16, "
                                                     "\"single_env_sample\" {}",
                                                     single)))
            .plate("m");
        return Probe(scene).direct_only().paths_of_pixel(paths).onto(Vec3(0), kUp, 30, 1 << 13);
      };
      const Measured one = measure("on"), all = measure("off");
      const double rays = paths > 1 ? 1 : 16;
      EXPECT_NEAR(one.each(one.counts.reflect), rays, .001);  // a few are lost below the horizon
      EXPECT_EQ(one.each(one.counts.environment), 1);
      EXPECT_NEAR(all.each(all.counts.environment), rays, .001);
      EXPECT_NEAR(one.mean.x, off > 0 ? 1 : 0,
                  .0005f);  // the table of albedos the lobe is white by
      figure(fmt::format("one look-up {} deg from the edge of a sky", off), off > 0 ? 1 : 0,
             one.mean.x, one.error.x);
      // Rays that look for themselves find both sides of the edge.
      EXPECT_NEAR(all.mean.x, .5f, .15f);
    }
}

}  // namespace ray_count_test
}  // namespace oriel::testing
