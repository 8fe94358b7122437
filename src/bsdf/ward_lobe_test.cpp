// SPDX-License-Identifier: Apache-2.0
#include "bsdf/ward_lobe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/highlights.h"
#include "sampling/testing/chi_square.h"

namespace oriel::bsdf {
namespace ward_lobe_test {

TEST(WardLobe, DirectionsMatchTheirDensity) {
  const Vec3 wo(-.6f, 0, .8f);
  for (const Vec2& shiny : {Vec2(4, 4), Vec2(3, 9)}) {
    const WardLobe lobe(shiny.x, shiny.y);
    const testing::DirectionTest test = testing::test_directions(
        [&](const Vec2& u, float) -> std::optional<Vec3> { return lobe.sample(wo, u); },
        [&](const Vec3& w) { return lobe.pdf(wo, w); }, 40000, 21);
    EXPECT_NEAR(test.pdf_integral, 1, 2e-3);
    EXPECT_NEAR(test.drawn, 1, 1e-9);
    EXPECT_GT(test.chi.p_value, testing::sidak(.01, 2));
  }
}

// The slopes are the reciprocals of the shininess; the highlight includes the cosine.
TEST(WardLobe, IsWardsReflectance) {
  const Vec3 wo(0, 0, 1), wi(.28f, 0, .96f);
  const float highlight = WardHighlight{.25f, .125f}.eval(wo, wi);
  EXPECT_FLOAT_EQ(WardLobe(4, 8).relative_to_lambert(wo, wi), kPi * highlight / .96f);
  EXPECT_EQ(WardLobe(4, 8).relative_to_lambert(wo, Vec3(.28f, 0, -.96f)), 0);
}

// A shininess of 0 has mean slopes of 10 instead of infinite ones.
TEST(WardLobe, HasAWidestSlope) {
  const Vec3 wo(0, 0, 1), wi(.6f, 0, .8f);
  const float widest = WardLobe(0, 0).relative_to_lambert(wo, wi);
  EXPECT_EQ(widest, WardLobe(.1f, .1f).relative_to_lambert(wo, wi));
  const float highlight = WardHighlight{10, 10}.eval(wo, wi);
  EXPECT_FLOAT_EQ(widest, kPi * highlight / .8f);
}

}  // namespace ward_lobe_test
}  // namespace oriel::bsdf
