// SPDX-License-Identifier: Apache-2.0
// Statements of the manual that hold for path tracing, final gathering and photons.
#include "support/picture.h"
#include "support/portal_scenes.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace method_modes_test {

/// Rays and mean of a card that a sky lights, by final gathering.
struct Gathered {
  double rays;
  Rgb mean;
};
Gathered gathered_card(const std::string& more) {
  SceneText scene("trace depth 4 4 8 finalgather on finalgather accuracy 200");
  scene.method("scene")
      .uniform_sky(1)
      .lambert("card", .5f, more)
      .square("card", Vec3(0, 0, -1), 3, kUp)
      .camera("focal 1 aperture .2 aspect 1 resolution 8 8");
  RenderedScene rendered(scene, {.budget = {.samples = 4}});
  return {double(rendered.session().rays().gather), rendered.mean()};
}

// acceptance: P6
TEST(GatherQuality, ActsUnderFinalGatheringBelowOneAsWell) {
  const Gathered one = gathered_card("\"fg_quality\" 1, \"fg_quality_w\" 0");
  for (const float quality : {.25f, .5f, 3.0f}) {
    const Gathered g = gathered_card(fmt::format("\"fg_quality\" {}, \"fg_quality_w\" 0", quality));
    // The number of points differs a little.
    EXPECT_NEAR(g.rays / one.rays / double(quality), 1, .08) << quality;
    EXPECT_NEAR(g.mean.x, .5f, .01f);
  }
  // With a weight, the options are the minimum.
  EXPECT_EQ(gathered_card("\"fg_quality\" .25, \"fg_quality_w\" 2").rays, one.rays);
}

// acceptance: P6
TEST(IndirectMultiplier, ScalesGatheredLight) {
  for (const float by : {0.0f, .5f, 2.0f})
    EXPECT_NEAR(gathered_card(fmt::format("\"indirect_multiplier\" {}", by)).mean.x, .5f * by,
                .02f * by + 1e-6f);
}

// acceptance: P5
TEST(MagicWall, ScattersPhotonsAsAnyWall) {
  // A light in front of the culled wall, which faces away from the camera.
  const auto photons = [](bool culled) {
    SceneText scene;
    scene.lambert("floor", .5f)
        .lambert("wall", .5f, culled ? "\"backface_cull\" on" : "\"backface_cull\" off")
        .square("floor", Vec3(0, 0, 0), 2, kUp)
        .square("wall", Vec3(0, 1, 1), 1, Vec3(0, -1, 0))
        .light("lamp", "\"physical_light\" ( \"color\" 10 10 10 ) origin 0 0 1");
    const Probe probe(scene);
    PhotonSettings settings;
    settings.globillum = true;
    settings.each.global.emit = 50000;
    RayCounts counts;
    return trace_photons(probe.world(), settings, counts).global.photons();
  };
  const auto plain = photons(false), culled = photons(true);
  ASSERT_GT(plain.size(), 1000u);
  ASSERT_EQ(plain.size(), culled.size());
  double off_wall = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].position, culled[i].position) << i;
    off_wall += culled[i].position.y < .99f && culled[i].direction.y < 0;
  }
  EXPECT_GT(off_wall, 100) << "photons that the wall sent to the floor";
}

// acceptance: L8
TEST(Portal, RealFinalGatheringOfOneBounceLightsTheWallAboveTheWindow) {
  const auto wall = [](bool portal, const std::string& method) {
    SceneText scene =
        room(kSky, .5f, {}, "trace depth 4 4 8 finalgather on finalgather accuracy 200");
    scene.method(method);
    if (portal) add_window(scene);
    // From inside, at the wall above the window.
    scene.camera("focal 1 aperture .2 aspect 1 resolution 8 8",
                 "0 0 1 0  1 0 0 0  0 1 0 0  0 -2.6 -2 1");
    return RenderedScene(scene.str(), {.budget = {.samples = 16}}, registry()).mean();
  };
  const std::string once = "scene";
  EXPECT_LT(wall(false, once).y, 1e-3f) << "one bounce sees walls that nothing lights";
  const float lit = wall(true, once).y, all = wall(true, "path").y;
  EXPECT_GT(lit, .2f * all);
  EXPECT_LT(lit, all);
}

}  // namespace method_modes_test
}  // namespace oriel::testing
