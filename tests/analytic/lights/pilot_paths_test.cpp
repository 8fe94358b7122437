// SPDX-License-Identifier: Apache-2.0
// The choice between settings of paths by a few paths before the picture.
#include "transport/path/pilot_paths.h"

#include "base/parallel.h"
#include "support/probe.h"

namespace oriel::testing {
namespace pilot_paths_test {

/// A floor under a lamp of 2 `half` on a side.
SceneText lamp_over_floor(float half) {
  SceneText scene;
  scene.lambert("white", .5f).plate("white");
  scene.light("lamp", fmt::format("\"physical_light\" ( \"color\" 9 9 9 ) origin 0 0 1 direction "
                                  "0 0 -1 rectangle {0} 0 0 0 {0} 0 3 3",
                                  2 * half));
  return scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32",
                      "transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -4 1");
}

float ratio(const World& world, Estimator a, Estimator b, std::uint32_t seed = 0) {
  PathSettings of_a, of_b;
  of_a.estimator = a;
  of_b.estimator = b;
  RayCounts counts;
  const auto pilots = [&](const PathSettings& settings) {
    return PilotPaths(world, {0, 0, 32, 32}, settings, seed, counts);
  };
  return pilots(of_a).compare(pilots(of_b)).efficiency();
}

TEST(PilotPaths, PreferTheSettingsWithLessNoise) {
  // Rays rarely find a lamp of .2 x .2 at distance 1; samples of it are nearly exact.
  const Probe probe(lamp_over_floor(.1f));
  const World& world = probe.world();
  EXPECT_GT(ratio(world, Estimator::LightOnly, Estimator::BsdfOnly), 4);
  EXPECT_LT(ratio(world, Estimator::BsdfOnly, Estimator::LightOnly), .25f);
}

TEST(PilotPaths, SettingsThatMissTheLightAreNotPreferred) {
  // One of 8000 rays finds a lamp of .02 x .02 at distance 1: one pixel of 500 has any light.
  const Probe probe(lamp_over_floor(.01f));
  for (std::uint32_t seed = 0; seed < 4; ++seed)
    EXPECT_GT(ratio(probe.world(), Estimator::LightOnly, Estimator::BsdfOnly, seed), 30) << seed;
}

TEST(PilotPaths, FindNoDifferenceBetweenEqualSettings) {
  const Probe probe(lamp_over_floor(.5f));
  double sum = 0;
  constexpr int kSeeds = 8;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
    sum += ratio(probe.world(), Estimator::Mis, Estimator::Mis, seed) / double(kSeeds);
  EXPECT_NEAR(sum, 1, .2);
}

TEST(PilotPaths, KnowTheNoiseOfAPath) {
  // A lamp of 1 x 1 at distance 1, which the rays of the visible part of the floor find alike.
  SceneText scene = lamp_over_floor(.5f);
  scene.camera("focal 1 aperture .1 aspect 1 resolution 32 32",
               "transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -4 1");
  const Probe probe(scene);
  const World& world = probe.world();
  PathSettings rays;
  rays.estimator = Estimator::BsdfOnly;
  RayCounts counts;
  // The variance of means of eight stratified paths.
  constexpr int kMeans = 2048, kPaths = 8;
  double sum = 0, squares = 0;
  for (int i = 0; i < kMeans; ++i) {
    double mean = 0;
    for (std::uint32_t k = 0; k < kPaths; ++k) {
      sampling::Sampler sampler(i, 0, k, 7);
      const Vec2 raster = Vec2(float(i % 32), float(i / 32 % 32)) + sampler.next_2d();
      mean += static_cast<double>(
                  trace_path(world, world.camera.ray(raster), raster, rays, sampler, counts)
                      .radiance.y) /
              kPaths;
    }
    sum += mean / kMeans;
    squares += mean * mean / kMeans;
  }
  const double expected = kPaths * (squares / (sum * sum) - 1);
  const PilotPaths pilots(world, {0, 0, 32, 32}, rays, 0, counts, 2048);
  // The light of a pixel is known by four means only, which divides by too little.
  EXPECT_GT(pilots.noise_of_path(), .9 * expected);
  EXPECT_LT(pilots.noise_of_path(), 1.6 * expected);
}

TEST(PilotPaths, CountRareFindsAsNoise) {
  // Beside a large lamp, one of about 900 rays finds an emissive square of .06 x .06 at distance
  // 1. Samples of the square have hardly any noise.
  SceneText scene = lamp_over_floor(.5f);
  scene.emitter("glow", 3).polygon("glow", {Vec3(-.03f, .03f, 1), Vec3(.03f, .03f, 1),
                                            Vec3(.03f, -.03f, 1), Vec3(-.03f, -.03f, 1)});
  const Probe probe(scene);
  RayCounts counts;
  PathSettings settings;
  const PilotPaths samples(probe.world(), {0, 0, 32, 32}, settings, 0, counts, 4096);
  settings.mesh_lights = false;
  const PilotPaths rays(probe.world(), {0, 0, 32, 32}, settings, 0, counts, 4096);
  // They are in less than a hundredth of the pixels, which compare() leaves out.
  EXPECT_GT(samples.compare_finds(rays).efficiency(), 5 * samples.compare(rays).efficiency());
  EXPECT_EQ(samples.compare_finds(samples).efficiency(), 1);
}

TEST(PilotPaths, DoNotDependOnTheNumberOfThreads) {
  const Probe probe(lamp_over_floor(.1f));
  const float many = ratio(probe.world(), Estimator::Mis, Estimator::BsdfOnly);
  const ThreadLimit one(1);
  EXPECT_EQ(ratio(probe.world(), Estimator::Mis, Estimator::BsdfOnly), many);
}

TEST(PilotPaths, ScenesWithoutLightHaveNoPreference) {
  SceneText dark;
  dark.lambert("white", .5f).plate("white").camera("focal 1 aperture 1 aspect 1 resolution 8 8");
  EXPECT_EQ(ratio(Probe(dark).world(), Estimator::Mis, Estimator::BsdfOnly), 1);
}

}  // namespace pilot_paths_test
}  // namespace oriel::testing
