// SPDX-License-Identifier: Apache-2.0
// Reflections without rays, computed from final gathering results.
#include <gtest/gtest.h>

#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "support/probe.h"

namespace oriel::testing {
namespace emulated_reflection_test {

/// A board that looks down on a red floor and up at a blue ceiling at a slant, seen from below.
struct Board {
  testing::PreparedScene scene;
  std::unique_ptr<RenderSession> session;

  explicit Board(const std::string& reflection, scene::IndirectMethod method)
      : scene(text(reflection)) {
    scene.world->options.indirect = method;
    SessionSettings settings;
    settings.budget.samples = 16;
    settings.outputs = true;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  static std::string text(const std::string& reflection) {
    SceneText s("trace depth 4 4 8 finalgather on finalgather accuracy 400");
    s.material("floor", "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" 1 0 0")
        .material("ceiling", "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" 0 0 1")
        .material("board",
                  "\"diffuse\" 0 0 0, \"reflectivity\" .5, \"brdf_0_degree_refl\" 1, " + reflection)
        .square("floor", Vec3(0, -2, -2), 20, Vec3(0, 1, 0))
        .square("ceiling", Vec3(0, 2, -2), 20, Vec3(0, -1, 0))
        .square("board", Vec3(0, 0, -2), 1, Vec3(0, 0, 1))
        .camera("focal 2 aperture 1 aspect 1 resolution 16 16");
    return s.str();
  }
  /// Mean of the reflection over a part of the picture.
  Rgb reflection(int y0, int y1) const {
    Rgb sum(0);
    for (int y = y0; y < y1; ++y)
      for (int x = 4; x < 12; ++x) sum += session->film().outputs(x, y)[Aov::Reflection];
    return sum / static_cast<float>(8 * (y1 - y0));
  }
};

constexpr auto kGather = scene::IndirectMethod::FinalGather;
constexpr auto kPath = scene::IndirectMethod::Path;

// acceptance: R5
TEST(EmulatedReflection, UsesGatheredColourWithoutRays) {
  const Board emulated("\"refl_gloss\" 0, \"refl_hl_only\" on", kGather);
  EXPECT_EQ(emulated.session->rays().reflect, 0u);
  // Viewed from the middle, the upper half mirrors the objects above, the lower half those below.
  const Rgb up = emulated.reflection(2, 7), down = emulated.reflection(9, 14);
  EXPECT_GT(up.z, 1.15f * up.x);
  EXPECT_GT(down.x, 1.15f * down.z);
  // As bright as with reflection rays, within the resolution of nine coefficients.
  const Board traced("\"refl_gloss\" 0, \"refl_gloss_samples\" 64", kPath);
  const Rgb real = traced.reflection(2, 14), soft = emulated.reflection(2, 14);
  EXPECT_NEAR(soft.x / real.x, 1, 0.15f);
  EXPECT_NEAR(soft.z / real.z, 1, 0.15f);
}

// acceptance: R5
TEST(EmulatedReflection, ShowsHighlightsAloneWithoutFinalGathering) {
  const Board none("\"refl_gloss\" 0, \"refl_hl_only\" on", kPath);
  EXPECT_EQ(none.reflection(2, 14), Rgb(0));
  EXPECT_EQ(none.session->rays().reflect, 0u);
}

// acceptance: R7
TEST(EmulatedReflection, TakesOverWhereTheMaterialsDepthEnds) {
  // Two facing boards: beyond depth 1 the second one shows gathered light, not black.
  const auto facing = [](scene::IndirectMethod method) {
    SceneText s("trace depth 4 4 8 finalgather on finalgather accuracy 200");
    s.uniform_sky(1)
        .material("near",
                  "\"diffuse\" 0 0 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                  "\"refl_depth\" 1")
        .square("near", Vec3(0, 0, -2), 1, Vec3(0, 0, 1))
        .square("near", Vec3(0, 0, 2), 1, Vec3(0, 0, -1))
        .camera("focal 4 aperture 1 aspect 1 resolution 8 8");
    testing::PreparedScene scene(s.str(), test_registry());
    EXPECT_EQ(scene.messages(), "");
    scene.world->options.indirect = method;
    SessionSettings settings;
    settings.budget.samples = 4;
    RenderSession session(*scene.world, settings);
    session.run();
    return session.film().pixel(4, 4).beauty.r;
  };
  EXPECT_EQ(facing(kPath), 0);
  EXPECT_GT(facing(kGather), 0.2f);
}

}  // namespace emulated_reflection_test
}  // namespace oriel::testing
