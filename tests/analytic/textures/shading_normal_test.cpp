// SPDX-License-Identifier: Apache-2.0
// Shading normals that differ from geometric normals: no light leaks, no dark or bright rims.
#include <gtest/gtest.h>

#include <cmath>

#include "support/probe.h"

namespace oriel::testing {
namespace shading_normal_test {

// acceptance: B1
TEST(ShadingNormal, LightBehindTheSurfaceStaysThereHoweverTheBumpLeans) {
  for (const char* kind : {"\"reflectivity\" 0, \"diffuse\" 1 1 1",
                           "\"reflectivity\" 1, \"brdf_0_degree_refl\" 1, \"refl_gloss\" .2"})
    for (const float height : {-.5f, .5f}) {
      SceneText scene;
      scene.material("m", std::string(kind) + ", \"bump_mode\" 6, \"standard_bump\" .95 0 .3")
          .square("m", Vec3(0), 2, kUp)
          .light("lamp",
                 fmt::format("\"mib_light_point\" ( \"color\" 9 9 9 ) origin 3 0 {}", height));
      // A light without shadows, so that only the normal can keep it out.
      const Measured m = Probe(scene).onto(Vec3(0), kUp, 20, 64);
      if (height < 0)
        EXPECT_EQ(m.mean, Rgb(0)) << kind;
      else
        EXPECT_GT(m.mean.x, 0.1f) << kind;
    }
}

/// A coarse ball with smooth normals under an even sky of 1, seen along lines to its rim.
void expect_rims(const char* material, float least, float most) {
  SceneText scene;
  scene.uniform_sky(1).material("m", material).sphere("m", Vec3(0), 1, 5);
  const Probe probe(scene);
  int seen = 0;
  for (int i = 0; i < 120; ++i) {
    const float across = 0.5f + 0.5f * static_cast<float>(i) / 120;
    for (const float turn : {0.0f, 0.7f, 2.1f}) {
      const Vec3 from(across * std::cos(turn), across * std::sin(turn), 4);
      const Measured m = probe.ray(from, Vec3(0, 0, -1), 256);
      EXPECT_GT(m.mean.x, least - 4 * m.error.x) << material << " at " << across;
      EXPECT_LT(m.mean.x, most + 4 * m.error.x) << material << " at " << across;
      ++seen;
    }
  }
  EXPECT_EQ(seen, 360);
}

TEST(ShadingNormal, RimsOfCoarseSpheresHaveNoArtifacts) {
  const std::string metal =
      "\"diffuse\" 1 1 1, \"refl_is_metal\" on, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
      "\"refl_depth\" 0, \"refl_cutoff\" 0, ";
  expect_rims((metal + "\"refl_gloss\" 1").c_str(), 0.999f, 1.001f);
  // A glossy lobe loses what falls below the flat triangle.
  expect_rims((metal + "\"refl_gloss\" .4").c_str(), 0.75f, 1.001f);
  expect_rims("\"reflectivity\" 0, \"diffuse\" 1 1 1", 0.8f, 1.001f);
}

// acceptance: D1
TEST(ShadingNormal, TheEdgeOfShadowFallsSoftlyOnCoarseBalls) {
  SceneText scene;
  scene.lambert("m", 1)
      .sphere("m", Vec3(0), 1, 8)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction -1 0 0");
  const Probe probe = std::move(Probe(scene).direct_only());
  // Around the equator, away from the light: the terminator.
  float before = 0, steepest = 0;
  for (float degrees = 60; degrees <= 110; degrees += .25f) {
    const float a = degrees * kPi / 180;
    const Vec3 out(std::cos(a), std::sin(a), 0.05f);
    const Measured m = probe.ray(out * 3.0f, -out, 16);
    if (degrees > 60) steepest = std::max(steepest, std::abs(m.mean.x - before));
    before = m.mean.x;
  }
  EXPECT_EQ(before, 0);
  // Flat self-shadowing alone would switch a facet off at .2 and more.
  EXPECT_LT(steepest, 0.15f);
  std::printf("steepest step at the edge of shadow: %.3f\n", double{steepest});
}

}  // namespace shading_normal_test
}  // namespace oriel::testing
