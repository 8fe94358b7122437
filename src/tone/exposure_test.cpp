// SPDX-License-Identifier: Apache-2.0
// Photographic and simple exposure compared with closed forms and worked examples.
#include "tone/exposure.h"

#include "color/luminance.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace oriel::lens {
namespace exposure_test {

/// Exposure only: linear curve, no gamma.
PhotographicParameters linear() {
  PhotographicParameters p;
  p.vignetting = 0;
  p.burn_highlights = 1;
  p.crush_blacks = 0;
  p.gamma = 1;
  return p;
}

/// The curve only: input is already exposed.
PhotographicParameters curve(float burn, float crush) {
  PhotographicParameters p = linear();
  p.film_iso = 0;
  p.burn_highlights = burn;
  p.crush_blacks = crush;
  return p;
}

float grey(const PhotographicParameters& p, float value) {
  return PhotographicExposure(p)(Rgb(value)).y;
}

// acceptance: X3
TEST(PhotographicExposure, SunnySixteenSaturatesAt30720) {
  EXPECT_NEAR(grey(linear(), 30720), 1, 1e-6f);
  // A white card under 96.5 klx has that luminance.
  EXPECT_NEAR(grey(linear(), 96500 / kPi), 1, 1e-3f);
}

// acceptance: X3
TEST(PhotographicExposure, SaturationLuminanceFollowsExposureValue) {
  PhotographicParameters p = linear();
  p.f_number = 8;  // 1/2 s, EV 7
  p.camera_shutter = 2;
  EXPECT_NEAR(grey(p, 153.6f), 1, 1e-6f);
  p.f_number = 16;
  p.camera_shutter = 125;
  EXPECT_NEAR(grey(p, 38400), 1, 1e-6f);
  p = linear();
  p.exposure_constant = kPlainExposure;
  EXPECT_NEAR(grey(p, 25600), 1, 1e-6f);
}

// acceptance: X3
TEST(PhotographicExposure, HalvingEitherWayIsEqual) {
  const PhotographicParameters base = linear();
  PhotographicParameters iso = base, shutter = base, aperture = base;
  iso.film_iso /= 2;
  shutter.camera_shutter *= 2;
  aperture.f_number *= std::sqrt(2.0f);
  for (float v : {10.0f, 3000.0f, 90000.0f}) {
    const float half = 0.5f * grey(base, v);
    EXPECT_FLOAT_EQ(grey(iso, v), half);
    EXPECT_FLOAT_EQ(grey(shutter, v), half);
    EXPECT_FLOAT_EQ(grey(aperture, v), half);
  }
}

// acceptance: X3
TEST(PhotographicExposure, EqualExposureGivesEqualPixels) {
  // f/16 1/100 ISO 100; opening by two stops equals a shorter time or slower film by two stops,
  // with all curves.
  PhotographicParameters a, b, c;
  b.f_number = 8;
  b.camera_shutter = 400;
  c.f_number = 8;
  c.film_iso = 25;
  const Rgb scene(12000, 7000, 900);
  const Rgb expected = PhotographicExposure(a)(scene, 0.9f);
  EXPECT_EQ(PhotographicExposure(b)(scene, 0.9f), expected);
  EXPECT_EQ(PhotographicExposure(c)(scene, 0.9f), expected);
}

TEST(PhotographicExposure, Cm2FactorConvertsToLuminance) {
  PhotographicParameters p = linear();
  p.cm2_factor = 1500 / kPi;
  EXPECT_FLOAT_EQ(grey(p, 30720 / p.cm2_factor), 1);
}

// acceptance: X4
TEST(PhotographicExposure, IsoZeroIsPlainGain) {
  PhotographicParameters p = linear();
  p.film_iso = 0;
  for (float gain : {0.0f, 0.25f, 1.0f, 7.5f}) {
    p.cm2_factor = gain;
    EXPECT_FLOAT_EQ(grey(p, 0.4f), 0.4f * gain);
    PhotographicParameters other = p;
    other.camera_shutter = 1;
    other.f_number = 2.8f;
    EXPECT_EQ(grey(other, 0.4f), grey(p, 0.4f));
  }
}

// acceptance: X5
TEST(PhotographicExposure, WhitepointBecomesGreyOfItsLuminance) {
  for (const Rgb& white : {Rgb(1.04287f, 0.983863f, 1.03358f), Rgb(1, 0.7f, 0.4f)}) {
    PhotographicParameters p = curve(1, 0);
    p.whitepoint = white;
    for (float intensity : {0.1f, 1.0f, 20.0f}) {
      const Rgb out = PhotographicExposure(p)(white * intensity);
      const float y = luminance(white * intensity);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(out[i], y, 1e-5f * y);
    }
    // Only its hue matters, not its brightness.
    PhotographicParameters brighter = p;
    brighter.whitepoint = white * 5;
    const Rgb scene(0.3f, 0.2f, 0.6f);
    const Rgb a = PhotographicExposure(p)(scene), b = PhotographicExposure(brighter)(scene);
    EXPECT_LT(length(a - b), 1e-6f);
  }
}

// acceptance: X6
TEST(PhotographicExposure, VignettingIsAPowerOfTheCosine) {
  PhotographicParameters p = curve(1, 0);
  const auto at = [&](float exponent, float degrees) {
    p.vignetting = exponent;
    return PhotographicExposure(p)(Rgb(1), std::cos(degrees * kPi / 180)).x;
  };
  EXPECT_NEAR(at(3, 30), 0.649519f, 1e-6f);
  EXPECT_NEAR(at(6, 20), 0.688517f, 1e-6f);
  EXPECT_EQ(at(0, 60), 1);
  EXPECT_EQ(at(3, 0), 1);
}

// acceptance: X7
TEST(PhotographicExposure, Burn1Crush0IsExactlyLinear) {
  for (float v : {0.0f, 1e-4f, 0.18f, 1.0f, 40.0f, 1e30f}) EXPECT_EQ(grey(curve(1, 0), v), v);
}

// acceptance: X7
TEST(PhotographicExposure, BurnMatchesTable) {
  const float table[][3] = {{.25f, .1f, .093182f}, {.25f, 1, .625f}, {.25f, 4, 1.6f},
                            {.5f, 1, .75f},        {.5f, 4, 2.4f},   {0, 4, .8f}};
  for (const auto& [burn, in, out] : table) EXPECT_NEAR(grey(curve(burn, 0), in), out, 1e-6f);
}

// acceptance: X7
TEST(PhotographicExposure, Burn0NeverExceedsWhite) {
  float previous = -1;
  for (float v = 1e-3f; v < 1e9f; v *= 3) {
    const float out = grey(curve(0, 0), v);
    EXPECT_LE(out, 1);
    EXPECT_GE(out, previous);
    previous = out;
  }
  EXPECT_NEAR(grey(curve(0, 0), 1e9f), 1, 1e-6f);
}

// acceptance: X7
TEST(PhotographicExposure, CrushMatchesTable) {
  EXPECT_NEAR(grey(curve(1, 0.2f), 0.25f), 0.196794f, 1e-6f);
  // White and brighter values are unchanged; dark values are reduced the more the darker they are.
  EXPECT_FLOAT_EQ(grey(curve(1, 0.5f), 1), 1);
  EXPECT_FLOAT_EQ(grey(curve(1, 0.5f), 3), 3);
  EXPECT_LT(grey(curve(1, 0.6f), 0.1f), grey(curve(1, 0.2f), 0.1f));
  EXPECT_LT(grey(curve(1, 0.4f), 0.05f) / 0.05f, grey(curve(1, 0.4f), 0.5f) / 0.5f);
}

// acceptance: X7
TEST(PhotographicExposure, CurveIsMonotone) {
  for (float burn : {0.0f, 0.25f, 1.0f}) {
    for (float crush : {0.0f, 0.25f, 1.0f}) {
      float previous = -1;
      for (float v = 0; v < 3; v += 0.01f) {
        const float out = grey(curve(burn, crush), v);
        EXPECT_GT(out, previous) << burn << " " << crush << " " << v;
        previous = out;
      }
    }
  }
}

// acceptance: X7
TEST(PhotographicExposure, SaturationMovesAboutLuminance) {
  PhotographicParameters p = curve(1, 0);
  const Rgb scene(0.8f, 0.5f, 0.3f);
  const float y = luminance(scene);
  for (float s : {0.0f, 0.5f, 1.4f}) {
    p.saturation = s;
    const Rgb out = PhotographicExposure(p)(scene);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(out[i], y + s * (scene[i] - y), 1e-6f);
  }
  p.saturation = 10;
  EXPECT_EQ(PhotographicExposure(p)(scene).z, 0);
}

// acceptance: X7
TEST(PhotographicExposure, BurningTakesColourFromHighlights) {
  const Rgb scene(8, 2, 1);
  const Rgb out = PhotographicExposure(curve(0, 0))(scene);
  EXPECT_LT(out.x / out.z, 2);
  EXPECT_GT(out.x, out.y);
}

TEST(PhotographicExposure, GammaComesLast) {
  PhotographicParameters p = curve(0.25f, 0);
  p.gamma = 2.2f;
  EXPECT_NEAR(grey(p, 1), std::pow(0.625f, 1 / 2.2f), 1e-6f);
}

TEST(PhotographicExposure, NoExposureIsBlack) {
  PhotographicParameters p = linear();
  p.f_number = 0;
  EXPECT_EQ(grey(p, 1000), 0);
  p = linear();
  p.camera_shutter = 0;
  EXPECT_EQ(grey(p, 1000), 0);
}

// acceptance: X1
TEST(SimpleExposure, StepsComeInTheManualsOrder) {
  SimpleParameters p;
  p.gamma = 1;
  p.pedestal = 0.1f;
  p.gain = 2;
  // (0.1 + 0.1) 2 = 0.4 is below the knee; (0.65 + 0.1) 2 = 1.5 lies 1 above it.
  EXPECT_NEAR(SimpleExposure(p)(Rgb(0.1f)).x, 0.4f, 1e-6f);
  EXPECT_NEAR(SimpleExposure(p)(Rgb(0.65f)).x, 0.5f + 1.0f / 3, 1e-6f);
  p.gamma = 2.2f;
  EXPECT_NEAR(SimpleExposure(p)(Rgb(0.65f)).x, std::pow(0.833333f, 1 / 2.2f), 1e-6f);
  p.pedestal = -0.3f;
  EXPECT_EQ(SimpleExposure(p)(Rgb(0.2f)).x, 0);
}

// acceptance: X1
TEST(SimpleExposure, KneeMatchesTable) {
  SimpleParameters p;
  p.gamma = 1;
  EXPECT_NEAR(SimpleExposure(p)(Rgb(1)).x, 0.666667f, 1e-6f);
  EXPECT_NEAR(SimpleExposure(p)(Rgb(2)).x, 1.0f, 1e-6f);
  p.curve = KneeCurve::Asymptotic;
  EXPECT_NEAR(SimpleExposure(p)(Rgb(1)).x, 0.75f, 1e-6f);
  EXPECT_NEAR(SimpleExposure(p)(Rgb(1e9f)).x, 1.0f, 1e-6f);
}

// acceptance: X1
TEST(SimpleExposure, CompressionZeroIsNone) {
  for (KneeCurve curve : {KneeCurve::Ratio, KneeCurve::Asymptotic}) {
    SimpleParameters p;
    p.gamma = 1;
    p.compression = 0;
    p.curve = curve;
    for (float v : {0.2f, 0.5f, 0.9f, 12.0f}) EXPECT_FLOAT_EQ(SimpleExposure(p)(Rgb(v)).x, v);
  }
}

// acceptance: X1
TEST(SimpleExposure, IsMonotoneAndContinuousAtTheKnee) {
  for (KneeCurve curve : {KneeCurve::Ratio, KneeCurve::Asymptotic}) {
    SimpleParameters p;
    p.gamma = 1;
    p.curve = curve;
    const SimpleExposure expose(p);
    float previous = -1;
    for (float v = 0; v < 5; v += 0.01f) {
      EXPECT_GT(expose(Rgb(v)).x, previous);
      previous = expose(Rgb(v)).x;
    }
    const float step = 1e-3f;
    EXPECT_NEAR(expose(Rgb(0.5f + step)).x, expose(Rgb(0.5f)).x, 1.01f * step);
    // Slope just above the knee: a third for the ratio, one for the smooth form.
    const float slope = (expose(Rgb(0.5f + step)).x - expose(Rgb(0.5f)).x) / step;
    EXPECT_NEAR(slope, curve == KneeCurve::Ratio ? 1.0f / 3 : 1.0f, 5e-3f);
  }
}

TEST(Exposure, IsFiniteAndNeverNegative) {
  std::mt19937 random(7);
  const auto uniform = [&](float lo, float hi) {
    return std::uniform_real_distribution<float>(lo, hi)(random);
  };
  const float inf = std::numeric_limits<float>::infinity();
  const float odd[] = {0, -1, inf, -inf, std::nanf(""), 1e38f, 1e-40f};
  for (int trial = 0; trial < 20000; ++trial) {
    PhotographicParameters p;
    p.cm2_factor = uniform(0, 10);
    p.whitepoint = Rgb(uniform(0, 2), uniform(0, 2), trial % 3 ? 1.0f : 0.0f);
    p.film_iso = trial % 4 ? uniform(0, 3200) : 0;
    p.vignetting = uniform(-1, 11);
    p.burn_highlights = uniform(0, 1.2f);
    p.crush_blacks = uniform(-1, 1);
    p.saturation = uniform(-1, 3);
    p.gamma = uniform(0, 3);
    p.camera_shutter = uniform(-1, 1000);
    SimpleParameters s;
    s.pedestal = uniform(-1, 1);
    s.gain = uniform(-1, 5);
    s.knee = uniform(-0.5f, 1);
    s.compression = uniform(-1, 6);
    s.gamma = p.gamma;
    s.curve = trial % 2 ? KneeCurve::Ratio : KneeCurve::Asymptotic;
    Rgb c(uniform(-1, 1e5f), uniform(0, 10), uniform(0, 1));
    if (trial % 2) c[trial % 3] = odd[trial % 7];
    const float cosine = trial % 5 ? uniform(0, 1) : uniform(-1, 1.1f);
    for (const Rgb& out : {PhotographicExposure(p)(c, cosine), SimpleExposure(s)(c)}) {
      ASSERT_TRUE(is_finite(out)) << "trial " << trial;
      ASSERT_TRUE(out.x >= 0 && out.y >= 0 && out.z >= 0) << "trial " << trial;
    }
  }
}

}  // namespace exposure_test
}  // namespace oriel::lens
