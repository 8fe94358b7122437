// SPDX-License-Identifier: Apache-2.0
// AgX compared with the published fit of its curve, PBR Neutral with numbers from its
// specification.
#include "tone/display_views.h"

#include <gtest/gtest.h>

#include <limits>

#include "color/srgb.h"

namespace oriel::lens {
namespace display_views_test {

TEST(DisplayViews, AgxCurveAgreesWithItsPublishedPolynomialFit) {
  // B. Wrensch, "Minimal AgX Implementation", 2023: mean squared error below 1e-5.
  const auto fit = [](double x) {
    const double x2 = x * x, x4 = x2 * x2;
    return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 +
           0.1191 * x - 0.00232;
  };
  double squares = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = double(i) / kSteps;
    EXPECT_NEAR(agx_curve(static_cast<float>(x)), fit(x), 0.012) << x;
    squares += std::pow(agx_curve(static_cast<float>(x)) - fit(x), 2) / kSteps;
  }
  EXPECT_LT(squares, 8e-6);
}

TEST(DisplayViews, AgxCurveRunsFromBlackThroughGreyToWhite) {
  EXPECT_NEAR(agx_curve(0), 0, 1e-6f);
  EXPECT_NEAR(agx_curve(1), 1, 1e-6f);
  EXPECT_NEAR(agx_curve(10 / 16.5f), 0.5f, 1e-6f);
  const float step = 1e-3f;
  EXPECT_NEAR((agx_curve(10 / 16.5f + step) - agx_curve(10 / 16.5f - step)) / (2 * step), 2, 1e-2f);
}

TEST(DisplayViews, GreyStaysGreyAndRises) {
  Rgb before_agx(-1), before_neutral(-1);
  for (float v = 1e-4f; v < 1e4f; v *= 1.1f) {
    const Rgb a = agx(Rgb(v)), n = pbr_neutral(Rgb(v));
    for (int i = 1; i < 3; ++i) {
      EXPECT_NEAR(a[i], a[0], 2e-6f) << v;
      EXPECT_NEAR(n[i], n[0], 1e-6f) << v;
    }
    EXPECT_GE(a.x, before_agx.x) << v;
    EXPECT_GE(n.x, before_neutral.x) << v;
    EXPECT_LE(a.x, 1);
    EXPECT_LE(n.x, 1);
    before_agx = a, before_neutral = n;
  }
  // A grey card maps to half of the display signal, slightly brighter than the linear value.
  EXPECT_NEAR(agx(Rgb(0.18f)).y, 0.5f, 1e-5f);
}

TEST(DisplayViews, AgxTakesColourFromBrightLightAndStaysInRange) {
  const auto spread = [](const Rgb& c) { return max_component(c) - std::min({c.x, c.y, c.z}); };
  const Rgb hue(1, 0.2f, 0.05f);
  EXPECT_GT(spread(agx(hue)), 0.2f);
  EXPECT_LT(spread(agx(hue * 100.0f)), spread(agx(hue)));
  for (const Rgb& c : {Rgb(1e9f, 0, 0), Rgb(0, 1e9f, 0), Rgb(0, 0, 1e9f), Rgb(0, 0, 0.2f)})
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(agx(c)[i], 0);
      EXPECT_LE(agx(c)[i], 1);
    }
}

// Computed by hand from the specification: x = min, f = x - x^2 / 0.16 up to 0.08, else 0.04.
TEST(DisplayViews, NeutralMatchesItsSpecification) {
  struct Row {
    Rgb in, out;
  };
  const Row rows[] = {
      {Rgb(0.5f, 0.3f, 0.2f), Rgb(0.46f, 0.26f, 0.16f)},
      {Rgb(0.08f, 0.5f, 0.8f), Rgb(0.04f, 0.46f, 0.76f)},
      {Rgb(0.04f, 0.2f, 0.3f), Rgb(0.01f, 0.17f, 0.27f)},  // f = 0.04 - 0.0016 / 0.16 = 0.03
      {Rgb(0), Rgb(0)},
      // p = 0.96: 1 - 0.0576 / 0.44 = 0.8690909.
      {Rgb(1), Rgb(0.8690909f)},
      // c = 3.96 1.96 0.96: p_n = 1 - 0.0576 / 3.44 = 0.9832558; g = 1 / (0.15 * 2.9767442 + 1).
      {Rgb(4, 2, 1), Rgb(0.9832558f, 0.6399514f, 0.4682992f)}};
  for (const Row& row : rows)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(pbr_neutral(row.in)[i], row.out[i], 2e-6f);
}

TEST(DisplayViews, NeutralOnlyTakesTheReflectedShareFromBaseColours) {
  for (float r : {0.08f, 0.4f, 0.8f})
    for (float g : {0.08f, 0.3f, 0.8f})
      for (float b : {0.08f, 0.6f, 0.8f}) {
        const Rgb out = pbr_neutral(Rgb(r, g, b));
        EXPECT_NEAR(out.x, r - 0.04f, 1e-6f);
        EXPECT_NEAR(out.y, g - 0.04f, 1e-6f);
        EXPECT_NEAR(out.z, b - 0.04f, 1e-6f);
      }
}

TEST(DisplayViews, NeutralKeepsHues) {
  // The relative position of the middle component is preserved.
  for (float level : {0.1f, 0.9f, 3.0f, 60.0f}) {
    const Rgb out = pbr_neutral(Rgb(1, 0.6f, 0.2f) * level);
    EXPECT_NEAR((out.y - out.z) / (out.x - out.z), 0.5f, 2e-4f) << level;
  }
}

TEST(DisplayViews, OddInputGivesColours) {
  const float inf = std::numeric_limits<float>::infinity();
  for (float odd : {inf, -inf, std::nanf(""), -1.0f, 1e38f})
    for (const Rgb& out : {agx(Rgb(odd, 0.5f, 0)), pbr_neutral(Rgb(odd, 0.5f, 0))})
      for (int i = 0; i < 3; ++i) {
        EXPECT_GE(out[i], 0) << odd;
        EXPECT_LE(out[i], 1) << odd;
      }
}

}  // namespace display_views_test
}  // namespace oriel::lens
