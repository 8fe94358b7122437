// SPDX-License-Identifier: Apache-2.0
#include "photometry/light_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::photometry {
namespace light_profile_test {

using testing::luminaire_direction;

/// A table of a function of polar angle and azimuth, both in degrees.
CandelaTable table_of(const std::function<float(float, float)>& f, float polar_step,
                      float azimuth_step, float polar_end = 180) {
  CandelaTable table;
  for (float p = 0; p <= polar_end + 1e-3f; p += polar_step) table.polar.push_back(p);
  for (float a = 0; a <= 360 + 1e-3f; a += azimuth_step) table.azimuth.push_back(a);
  for (const float a : table.azimuth)
    for (const float p : table.polar) table.candela.push_back(f(p, a));
  return table;
}

float cosine(float deg) { return std::cos(deg * kPi / 180); }

/// An asymmetric luminaire with a dark sector.
CandelaTable lopsided() {
  return table_of(
      [](float p, float a) {
        return std::max(0.0f, 300 * cosine(p) * (1.2f + cosine(a - 70)) - 60);
      },
      15, 30);
}

TEST(LightProfile, IsotropicAndLambertTablesHaveTheirKnownFlux) {
  const LightProfile isotropic(table_of([](float, float) { return 100.0f; }, 10, 360));
  EXPECT_NEAR(isotropic.flux(), 1256.637, 2e-3);  // 4 pi 100
  const LightProfile lambert(
      table_of([](float p, float) { return 1000 * std::max(0.0f, cosine(p)); }, .5f, 360, 90));
  EXPECT_NEAR(lambert.flux(), 3141.593, .05);  // pi 1000; linear between half degrees
  const LightProfile coarse(
      table_of([](float p, float) { return 1000 * std::max(0.0f, cosine(p)); }, 10, 360, 90),
      {.cubic = true});
  EXPECT_NEAR(coarse.flux(), 3141.593, 6);
}

TEST(LightProfile, EntriesAreMetAndBetweenThemIntensityIsLinear) {
  const CandelaTable table = lopsided();
  for (const bool cubic : {false, true}) {
    const LightProfile profile(table, {.cubic = cubic});
    for (std::size_t a = 0; a < table.azimuth.size(); ++a)
      for (std::size_t p = 1; p + 1 < table.polar.size(); ++p)
        EXPECT_NEAR(profile.evaluate(luminaire_direction(table.polar[p], table.azimuth[a])),
                    table.at(a, p), 2e-3f);
  }
  const LightProfile profile(table);
  const float middle = (table.at(2, 1) + table.at(3, 1) + table.at(2, 2) + table.at(3, 2)) / 4;
  EXPECT_NEAR(profile.evaluate(luminaire_direction(22.5f, 75)), middle, 2e-3f);
  EXPECT_EQ(
      LightProfile(table_of([](float, float) { return 1.0f; }, 45, 90, 90)).evaluate(Vec3(0, 0, 1)),
      0);
}

TEST(LightProfile, CubicsStayBetweenNeighboursAndComeNearerToSmoothCurves) {
  const auto smooth = [](float p, float) { return 500 * sqr(std::max(0.0f, cosine(p))); };
  const LightProfile straight(table_of(smooth, 15, 360, 90));
  const LightProfile cubic(table_of(smooth, 15, 360, 90), {.cubic = true});
  const LightProfile coarse(table_of(smooth, 15, 360, 90), {.cubic = true, .polar_cells = 12});
  double straight_error = 0, cubic_error = 0;
  for (float p = .5f; p < 90; ++p) {
    straight_error += std::abs(straight.evaluate(luminaire_direction(p, 9)) - smooth(p, 0));
    cubic_error += std::abs(cubic.evaluate(luminaire_direction(p, 9)) - smooth(p, 0));
    EXPECT_LE(cubic.evaluate(luminaire_direction(p, 9)), 500.001f);
  }
  EXPECT_LT(cubic_error, .5 * straight_error);
  // A grid of twelve cells has the values of the cubic every 7.5 degrees, linear in between.
  EXPECT_NEAR(coarse.evaluate(luminaire_direction(22.5f, 0)),
              cubic.evaluate(luminaire_direction(22.5f, 0)), .5f);
  EXPECT_NEAR(coarse.evaluate(luminaire_direction(26.25f, 0)),
              (coarse.evaluate(luminaire_direction(22.5f, 0)) +
               coarse.evaluate(luminaire_direction(30, 0))) /
                  2,
              .01f);
  // A step causes no overshoot.
  const LightProfile step(table_of([](float p, float) { return p < 40 ? 100.0f : 0.0f; }, 10, 360),
                          {.cubic = true});
  for (float p = 0; p <= 180; p += .5f) {
    EXPECT_GE(step.evaluate(luminaire_direction(p, 0)), 0);
    EXPECT_LE(step.evaluate(luminaire_direction(p, 0)), 100.001f);
  }
}

TEST(LightProfile, PeakAndBeamAnglesOfACosinePower) {
  const LightProfile profile(table_of(
      [](float p, float) { return 800 * std::pow(std::max(0.0f, cosine(p)), 8.0f); }, 1, 360, 90));
  EXPECT_FLOAT_EQ(profile.peak(), 800);
  EXPECT_NEAR(length(profile.peak_direction() - Vec3(0, 0, -1)), 0, 1e-6);
  const auto exact = [](double share) {
    return 2 * std::acos(std::pow(share, 1 / 8.0)) * 180 / 3.14159265358979;
  };
  const Vec3 down(0, 0, -1), across(1, 0, 0);
  EXPECT_NEAR(beam_width_deg(profile, down, across, .5f), exact(.5), .05);
  EXPECT_NEAR(beam_width_deg(profile, down, across, .1f), exact(.1), .05);
}

TEST(LightProfile, DirectionsAreDrawnInProportionToIntensity) {
  const CandelaTable tables[] = {
      lopsided(),
      table_of([](float p, float a) { return 5 + p * (a > 170 ? 2.0f : .1f); }, 60, 120),
      table_of([](float p, float) { return p < 20 ? 1000.0f : 0.0f; }, 10, 360, 90)};
  for (std::size_t i = 0; i < std::size(tables); ++i)
    for (const bool cubic : {false, true}) {
      const LightProfile profile(tables[i], {.cubic = cubic});
      const auto result = testing::test_directions(
          [&](const Vec2& u, float) -> std::optional<Vec3> { return profile.sample(u).direction; },
          [&](const Vec3& d) { return double{profile.pdf(d)}; }, 40000, 7);
      EXPECT_GT(result.chi.p_value, testing::sidak(.01, 6)) << i << (cubic ? " cubic" : "");
      EXPECT_NEAR(result.pdf_integral, 1, 1e-3);
    }
}

TEST(LightProfile, SampledFluxIsTheIntegratedFluxWithoutNoise) {
  const LightProfile profile(lopsided());
  for (int i = 0; i < 5000; ++i) {
    sampling::Sampler s(i, 0, 0);
    const LightProfile::Sample sample = profile.sample(s.next_2d());
    ASSERT_NEAR(length(sample.direction), 1, 1e-5);
    const float intensity = profile.evaluate(sample.direction);
    ASSERT_NEAR(intensity / sample.pdf, profile.flux(),
                2e-3f * profile.flux() + 2e-3f / sample.pdf);
  }
}

TEST(LightProfile, ATableOfZeroesGivesNoSample) {
  const LightProfile dark(table_of([](float, float) { return 0.0f; }, 90, 180));
  EXPECT_EQ(dark.flux(), 0);
  EXPECT_EQ(dark.sample(Vec2(.3f, .4f)).pdf, 0);
}

}  // namespace light_profile_test
}  // namespace oriel::photometry
