// SPDX-License-Identifier: Apache-2.0
// The solar disc in glossy reflections and blurred environments; vignetting of orthographic views;
// lenses with more rays than the limit.
#include "mi/reader.h"
#include "render/eye_rays.h"
#include "runtime/color_mapping.h"
#include "sky/physical_sky.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace sky_disc_test {

const Vec3 kToSun = normalize(Vec3(1, 0, .6f));

std::string sun(const std::string& parameters, const Vec3& to_sun = kToSun) {
  return "\"mia_physicalsun\" ( " + parameters + " ) direction " + text_of(-to_sun);
}

/// What glossy bundles see of the environment toward the sun.
Rgb bundle(const std::string& light, const std::string& around = {}) {
  SceneText scene;
  const std::string sky =
      "\"mia_physicalsky\" ( \"sun_direction\" " + text_of(kToSun) + ", \"haze\" 1 )";
  if (around.empty())
    scene.environment(sky);
  else
    scene.statement("shader \"sky\" " + sky).environment(around);
  if (!light.empty()) scene.light("sun", light);
  const Probe probe(scene);
  return rgb(environment_radiance(probe.world().environment, probe.world(), Vec3(0), kToSun,
                                  RayKind::Reflect, true));
}

// acceptance: S9, S11
TEST(SkyDisc, GlossyBundlesSeeItWhereNoLightShinesFromIt) {
  const sky::PhysicalSky sky({.haze = 1, .sun_direction = kToSun});
  const Rgb whole = sky.radiance(kToSun),
            glow = sky.radiance(kToSun, sky::SkyPart::GradientAndGlow);
  ASSERT_GT(whole.y, 10 * glow.y);
  const auto expect = [](const Rgb& found, const Rgb& exact, const char* what) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / exact[k], 1, 1e-5f) << what;
  };
  expect(bundle(""), whole, "no light");
  expect(bundle(sun("")), glow, "the sun's light");
  expect(bundle("\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction " + text_of(-kToSun)), glow,
         "any light");
  expect(bundle(sun("\"on\" off")), whole, "a light that is off");
  expect(bundle(sun("", normalize(Vec3(-1, .5f, .6f)))), whole, "a light from elsewhere");
  expect(bundle("\"mib_light_point\" ( ) origin 9 0 9"), whole, "a lamp");
}

// acceptance: S9
TEST(SkyDisc, BlurredEnvironmentsHaveItAsWell) {
  const std::string blurred =
      "\"mia_envblur\" ( \"environment\" \"sky\", \"blur\" .3, \"resolution\" 128 )";
  EXPECT_GT(bundle("", blurred).y, 1.1f * bundle(sun(""), blurred).y);
}

// acceptance: S9
TEST(SkyDisc, AGlossyMetalShowsItsDisc) {
  const auto seen = [](const char* disc, bool light) {
    SceneText scene;
    scene.environment(
        fmt::format("\"mia_physicalsky\" ( \"sun_direction\" {}, "
                    "\"sun_disk_intensity\" {}, \"sun_disk_scale\" 20 )",
                    text_of(kToSun), disc));
    scene
        .material("metal",
                  "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                  "\"brdf_90_degree_refl\" 1, \"refl_gloss\" .7")
        .square("metal", Vec3(0), 1, kUp);
    if (light) scene.light("sun", sun(""));
    const Vec3 down(kToSun.x, 0, -kToSun.z);
    return Probe(scene).ray(-down, down, 1 << 14);
  };
  EXPECT_GT(seen("1", false).mean.y, 2 * seen("0", false).mean.y);
  EXPECT_EQ(seen("1", true).mean, seen("0", true).mean);
}

TEST(SkyDisc, NonDirectionalSunIsReported) {
  Diagnostics diagnostics;
  SceneText scene;
  scene.light("sun", "\"mia_physicalsun\" ( ) origin 0 0 1");
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view n) { return test_registry().find(n) != nullptr; };
  scene::Scene read = mi::read_text(scene.str(), options, diagnostics);
  PrepareReport report;
  const auto world = prepare(read, read.renders.back(), test_registry(), {}, diagnostics, report);
  ASSERT_TRUE(world);
  EXPECT_TRUE(diagnostics.has("OR-RN-024"));
}

// acceptance: X6
TEST(Vignetting, DarkensPerspectiveCornersAndNothingOfAParallelView) {
  const auto corner = [](const char* focal) {
    SceneText scene;
    scene.uniform_sky(1).camera(std::string("focal ") + focal +
                                " aperture 2 aspect 1 resolution 8 8 lens "
                                "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"vignetting\" "
                                "3, \"burn_highlights\" 1, \"crush_blacks\" 0, \"gamma\" 1 )");
    const Probe probe(scene);
    return map_color(probe.world().lens, probe.world(), Vec2(0, 0), Rgb(1)).x;
  };
  // Half the film is as wide as it is far: the cosine of the corner is 1 / sqrt(3).
  EXPECT_NEAR(corner("1"), std::pow(1 / std::sqrt(3.0f), 3), 1e-5f);
  EXPECT_NEAR(corner("infinity"), 1, 1e-6f);
}

// acceptance: K4
TEST(LensRays, MoreThan256AreSent) {
  SceneText scene;
  scene.uniform_sky(1).camera(
      "focal 1 aperture 1 aspect 1 resolution 4 4 lens \"mia_lens_bokeh\" ( \"samples\" 1000, "
      "\"radius\" .1, \"plane\" 5 )");
  const Probe probe(scene);
  sampling::Sampler sampler(1, 1, 0);
  RayCounts counts;
  trace_eye_rays(probe.world(), Vec2(2, 2), sampler, counts);
  EXPECT_EQ(counts.eye, 1000u);
}

}  // namespace sky_disc_test
}  // namespace oriel::testing
