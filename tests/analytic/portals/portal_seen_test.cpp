// SPDX-License-Identifier: Apache-2.0
// Visible portals at a large distance: the threshold applies to their light, not to visibility.
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace portal_seen_test {

const std::string kMirror =
    "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
    "\"brdf_90_degree_refl\" 1";

/// A white card of 1 m2 at x = 0 facing +x, viewed from `distance`.
SceneText card(const std::string& threshold, float distance, const std::string& more = {}) {
  SceneText scene;
  add_portal(scene, "card", Vec3(0), 1, 1,
             "\"visible\" on, \"use_custom_environment\" on, \"cutoff_threshold\" " + threshold);
  scene.lambert("wall", 1)
      .material("mirror", kMirror)
      .material("metal", kMirror + ", \"refl_gloss\" .8, \"refl_gloss_samples\" 8")
      .material("glass",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                "\"thin_walled\" on, \"refr_ior\" 1");
  if (!more.empty()) scene.square(more, Vec3(distance, 0, 0), 3, Vec3(-1, 0, 0));
  return scene;
}

const Vec3 kOut(-1, 0, 0);

// The card's colour at the point is 1 / (pi d^2): .005, the default threshold, at 7.98 m.
// acceptance: L5
TEST(PortalSeen, RadianceIsIndependentOfDistance) {
  for (const float distance : {4.0f, 8.0f, 40.0f, 1000.0f}) {
    const Vec3 eye(distance, .1f, .1f);
    const std::string name = fmt::format("{} m", distance);
    expect_exact("card, " + name, probe_of(card(".005", distance)).ray(eye, kOut, 64), 1);
    // From before the mirror: back past the eye to the card.
    expect_exact(
        "mirrored card, " + name,
        probe_of(card(".005", distance, "mirror")).ray(eye - Vec3(1, 0, 0), Vec3(1, 0, 0), 64), 1);
    expect_exact("card behind glass, " + name,
                 probe_of(card(".005", distance, "glass")).ray(eye + Vec3(1, 0, 0), kOut, 64), 1);
  }
  // Its light is cut off there all the same.
  const auto lit = [](float distance) {
    return probe_of(card(".005", distance, "wall"))
        .onto(Vec3(distance, 0, 0), Vec3(-1, 0, 0), 0, 1 << 12, .1f)
        .mean.x;
  };
  EXPECT_NEAR(lit(7), 1 / (49 * kPi), .05f / (49 * kPi));
  EXPECT_EQ(lit(8.1f), 0);
}

// acceptance: L5
TEST(PortalSeen, InAGlossySurfaceIsThereAlthoughItsHighlightIsCutOff) {
  const auto seen = [](const char* threshold) {
    return probe_of(card(threshold, 20, "metal")).ray(Vec3(19, .1f, .1f), Vec3(1, 0, 0), 1 << 17);
  };
  const Measured whole = seen("0"), cut = seen(".005");
  EXPECT_GT(whole.mean.x, 1e-4f);
  expect_same("glossy card", cut, whole, .05f);
}

}  // namespace portal_seen_test
}  // namespace oriel::testing
