// SPDX-License-Identifier: Apache-2.0
#include "bsdf/gloss.h"

#include <gtest/gtest.h>

namespace oriel::bsdf {
namespace gloss_test {

TEST(Gloss, MatchesThePublishedMap) {
  const float table[][2] = {{0, .353553f},   {.1f, .217638f},  {.25f, .105112f}, {.3f, .082469f},
                            {.5f, .031250f}, {.75f, .009291f}, {.9f, .004487f},  {.99f, .002899f}};
  for (const auto& [gloss, alpha] : table) EXPECT_NEAR(gloss_to_alpha(gloss), alpha, 1e-6f);
  EXPECT_EQ(gloss_to_alpha(1), 0);
  EXPECT_EQ(gloss_to_alpha(2), 0);
  EXPECT_EQ(gloss_to_alpha(-1), gloss_to_alpha(0));
  EXPECT_FLOAT_EQ(gloss_to_alpha(0.25f, GlossModel::Linear), 0.5625f);
  EXPECT_EQ(gloss_to_alpha(1, GlossModel::Linear), 0);
}

TEST(Gloss, AnisotropyIsTheRatioOfWidths) {
  for (const float a : {0.1f, 0.5f, 1.0f, 2.0f, 10.0f})
    for (const float gloss : {0.0f, 0.3f, 0.9f, 0.99f}) {
      const Roughness r = gloss_to_roughness(gloss, a), turned = gloss_to_roughness(gloss, 1 / a);
      EXPECT_NEAR(r.ax / r.ay, a, 1e-5f * a);
      EXPECT_NEAR(r.ax, turned.ay, 1e-6f * r.ax);
      EXPECT_NEAR(r.ay, turned.ax, 1e-6f * r.ay);
      EXPECT_NEAR(r.ax * r.ay, sqr(gloss_to_alpha(gloss)), 1e-5f * r.ax * r.ay);
    }
}

TEST(Gloss, LimitsKeepTheRatio) {
  const Roughness r = anisotropic_roughness(1, 9);
  EXPECT_FLOAT_EQ(r.ax, kMaxAlpha);
  EXPECT_FLOAT_EQ(r.ax / r.ay, 9);
  EXPECT_TRUE(gloss_to_roughness(1).is_mirror());
  EXPECT_TRUE(anisotropic_roughness(0.9f * kMinAlpha, 10).is_mirror());
  EXPECT_FALSE(gloss_to_roughness(0.9999f).is_mirror());
  EXPECT_GE(anisotropic_roughness(kMinAlpha, 10).ay, kMinAlpha);
}

}  // namespace gloss_test
}  // namespace oriel::bsdf
