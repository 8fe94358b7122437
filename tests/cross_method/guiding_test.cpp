// SPDX-License-Identifier: Apache-2.0
// Paths with and without a guide of their directions.
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "render/session.h"
#include "scenes.h"
#include "support/probe.h"

namespace oriel::cross_method {
namespace guiding_test {

using testing::Measured;
using testing::Probe;

struct Case {
  const char* name;
  SceneText (*scene)();
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Guiding : public ::testing::TestWithParam<Case> {};

// acceptance: Q2
TEST_P(Guiding, KeepsTheMean) {
  constexpr int kSamples = 1 << 18;
  const SceneText scene = GetParam().scene();
  Probe guided(scene);
  const Measured with = guided.guided().picture(kSamples);
  const Measured without = Probe(scene).picture(kSamples);
  for (int c = 0; c < 3; ++c) {
    const float error = std::hypot(with.error[c], without.error[c]);
    EXPECT_NEAR(with.mean[c], without.mean[c], 3 * error) << "channel " << c;
    EXPECT_LE(error, .007f * without.mean[c]) << "too noisy";
  }
  testing::figure(GetParam().name, without.mean.y, with.mean.y,
                  std::hypot(with.error.y, without.error.y));
}

// acceptance: Q2
TEST_P(Guiding, MoreDiffuseRaysKeepTheMean) {
  constexpr int kSamples = 1 << 16;
  const SceneText scene = GetParam().scene();
  const Measured without = Probe(scene).picture(kSamples);
  for (const int rays : {2, 4}) {
    Probe split(scene);
    const Measured with = split.diffuse_rays(rays).picture(kSamples);
    for (int c = 0; c < 3; ++c) {
      const float error = std::hypot(with.error[c], without.error[c]);
      EXPECT_NEAR(with.mean[c], without.mean[c], 3 * error) << rays << " rays, channel " << c;
      EXPECT_LE(with.error[c], 1.1f * without.error[c]) << rays << " rays have more noise";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    CrossMethod, Guiding,
    ::testing::Values(Case{"closed_box", closed_box}, Case{"sky_window", sky_window},
                      Case{"sun_window", sun_window}, Case{"glossy_corner", glossy_corner},
                      Case{"glass_on_table", glass_on_table}, Case{"curtain", curtain},
                      Case{"glowing_sphere", glowing_sphere}, Case{"two_rooms", two_rooms},
                      Case{"sky_portal", sky_portal}, Case{"furnished", furnished}),
    [](const auto& i) { return std::string(i.param.name); });

/// A box of so many pixels that its paths are guided.
std::string large_box(const std::string& options, int side = 96) {
  SceneText scene = start(options);
  room(scene);
  ceiling_light(scene);
  std::string text = scene.str();
  const std::string small = "resolution 40 40";
  text.replace(text.find(small), small.size(), fmt::format("resolution {0} {0}", side));
  return text;
}

TEST(GuidedPictures, LearnLittleForANoiseTargetThatIsMetSoon) {
  const Probe probe(large_box("\"indirect\" \"path\"", 120));
  const auto rays_before = [&](float noise) {
    RenderSession session(probe.world(), {.budget = {.noise = noise}});
    session.prepare();
    return session.rays_before();
  };
  // 120 x 120 x 64 paths learn by some 600,000 rays; 16 samples of a pixel are too few to learn,
  // and only pilot paths find that.
  EXPECT_GT(rays_before(.01f), 300'000u);
  EXPECT_LT(rays_before(.5f), 150'000u);
  EXPECT_GT(rays_before(.5f), 0u);
}

/// The pixels of a window that starts at the lower left.
std::vector<Rgb> window(const std::string& scene, int side, int threads) {
  const ThreadLimit limit(threads);
  const Probe probe(scene);
  RenderSession session(probe.world(),
                        {.budget = {.samples = 32}, .crop = Window{0, 0, side, side}});
  session.run();
  std::vector<Rgb> pixels;
  for (int y = side - 4; y < side; ++y)
    for (int x = 0; x < 4; ++x) pixels.push_back(rgb(session.film().pixel(x, y).beauty));
  return pixels;
}

TEST(GuidedPictures, AreTheSameForAnyCropAndNumberOfThreads) {
  const std::string box = large_box("\"indirect\" \"path\"");
  const std::vector<Rgb> pixels = window(box, 4, 1);
  EXPECT_EQ(pixels, window(box, 8, 1)) << "crop";
  EXPECT_EQ(pixels, window(box, 4, 3)) << "threads";
  EXPECT_NE(pixels, window(large_box("\"indirect\" \"path\" \"guiding\" off"), 4, 1))
      << "no guide was used";
}

}  // namespace guiding_test
}  // namespace oriel::cross_method
