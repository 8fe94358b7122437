// SPDX-License-Identifier: Apache-2.0
// Occlusion of gathered light equals occlusion with path tracing.
#include "support/picture.h"

namespace oriel::testing {
namespace occlusion_gathered_test {

/// A floor with a dull or a glowing ball on it under an even sky, seen from above.
float floor_level(const std::string& occlusion, const std::string& method, float glow) {
  SceneText s("trace depth 4 4 8 finalgather on finalgather trace depth 4 4 8 16");
  s.uniform_sky(.4f)
      .lambert("floor", .5f, occlusion)
      .emitter("ball", glow)
      .square("floor", Vec3(0, 0, -3), 1.6f, Vec3(0, 0, 1))
      .sphere("ball", Vec3(0, 0, -2.5f), .5f, 24)
      .camera("focal 1 aperture 1 aspect 1 resolution 32 32");
  std::string text = s.str();
  text.replace(text.find("\"path\""), 6, '"' + method + '"');
  const Picture picture(text, 64);
  // A ring around the ball.
  double sum = 0;
  int count = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const float r = std::hypot(x - 15.5f, y - 15.5f);
      if (r < 9 || r > 13) continue;
      sum += picture.layers().front().image.at(x, y)[0];
      ++count;
    }
  return static_cast<float>(sum / count);
}

std::string details(int mode) {
  return fmt::format(
      "\"ao_on\" on, \"ao_distance\" 1, \"ao_samples\" 32, \"ao_dark\" .2 .2 .2, "
      "\"ao_do_details\" {}",
      mode);
}

// acceptance: O2, O3
TEST(GatheredOcclusion, ActsAsOnPaths) {
  for (const int mode : {0, 1, 2})
    for (const float glow : {0.f, 2.f}) {
      const float paths = floor_level(details(mode), "path", glow);
      // Colours replace a share of light that is already smoothed: a little stays twice.
      EXPECT_NEAR(floor_level(details(mode), "fg", glow) / paths, 1, mode == 2 ? .05 : .03)
          << mode << ' ' << glow;
    }
}

// acceptance: O2, O3
TEST(GatheredOcclusion, DarkensOrAddsTheLightOfNeighbours) {
  const float none = floor_level("", "fg", 2), dims = floor_level(details(1), "fg", 2),
              colors = floor_level(details(2), "fg", 2);
  EXPECT_LT(dims, .99f * none);
  EXPECT_GT(colors, dims) << "the glowing ball still shines on the floor";
}

}  // namespace occlusion_gathered_test
}  // namespace oriel::testing
