// SPDX-License-Identifier: Apache-2.0
#include "bsdf/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oriel::bsdf {
namespace fresnel_test {

float cos_deg(double degrees) { return static_cast<float>(std::cos(degrees * M_PI / 180)); }

/// Midpoint rule in sin^2 for the cosine-weighted mean.
template <typename F>
double quadrature_mean(const F& f) {
  constexpr int kSteps = 200000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += f(static_cast<float>(std::sqrt(1 - (i + 0.5) / kSteps))) / kSteps;
  return sum;
}

// acceptance: E5
TEST(Fresnel, DielectricMatchesTheTable) {
  const double table[][2] = {{0, .04},      {30, .041523}, {45, .050240},
                             {60, .089187}, {70, .171043}, {75, .253061},
                             {80, .387704}, {85, .612800}, {89, .904185}};
  for (const auto& [angle, r] : table)
    EXPECT_NEAR(fresnel_dielectric(cos_deg(angle), 1.5f), r, 2e-6) << angle;
  EXPECT_NEAR(fresnel_dielectric(1, 1.33f), .020059, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(cos_deg(60), 1.33f), .059126, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(0, 1.5f), 1, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(0.3f, 1), 0, 1e-7);
}

TEST(Fresnel, BrewsterAngleLosesTheParallelHalf) {
  // Only the perpendicular polarisation remains: ((n^2 - 1) / (n^2 + 1))^2 / 2.
  EXPECT_NEAR(fresnel_dielectric(cos_deg(56.3099), 1.5f), 0.5 * std::pow(1.25 / 3.25, 2), 1e-6);
}

TEST(Fresnel, FromBothCosines) {
  EXPECT_NEAR(fresnel_from_cosines(1, 1.5f, 1, 1), .04f, 1e-6f);
  // Brewster's angle, whose cosine inside is the sine outside.
  const float sine = 1.5f / std::sqrt(3.25f), cosine = 1 / std::sqrt(3.25f);
  EXPECT_NEAR(fresnel_from_cosines(1, 1.5f, cosine, sine), .5f * sqr(1.25f / 3.25f), 1e-6f);
  EXPECT_EQ(fresnel_from_cosines(1, 1.5f, 0, 0), 1);
}

TEST(Fresnel, IsTheSameFromBothSides) {
  for (double angle = 0; angle < 90; angle += 5) {
    const double inside = std::asin(std::sin(angle * M_PI / 180) / 1.5);
    EXPECT_NEAR(fresnel_dielectric(cos_deg(angle), 1.5f),
                fresnel_dielectric(static_cast<float>(std::cos(inside)), 1 / 1.5f), 2e-5);
  }
}

TEST(Fresnel, MeanMatchesTheTableAndQuadrature) {
  EXPECT_NEAR(fresnel_dielectric_mean(1.5f), .091778, 1e-6);
  EXPECT_NEAR(fresnel_dielectric_mean(1 / 1.5f), .596346, 1e-6);
  EXPECT_NEAR(fresnel_dielectric_mean(1.33f), .065931, 1e-6);
  EXPECT_NEAR(fresnel_dielectric_mean(1.4f), .076812, 1e-6);
  EXPECT_NEAR(fresnel_dielectric_mean(1.2f), .044280, 1e-6);
  EXPECT_EQ(fresnel_dielectric_mean(1), 0);
  for (const float n : {1.0005f, 1.01f, 1.8f, 2.6f, 4.0f, 0.75f, 0.4f})
    EXPECT_NEAR(fresnel_dielectric_mean(n),
                quadrature_mean([n](float c) { return fresnel_dielectric(c, n); }), 3e-5)
        << n;
}

// acceptance: E5
TEST(Fresnel, CurveMatchesTheTable) {
  const ReflectivityCurve curve{0.2f, 1, 5};
  EXPECT_FLOAT_EQ(curve(1), 0.2f);
  EXPECT_NEAR(curve(cos_deg(45)), .201724, 1e-6);
  EXPECT_NEAR(curve(cos_deg(60)), .225, 1e-6);
  EXPECT_NEAR(curve(cos_deg(75)), .378942, 1e-6);
  EXPECT_NEAR(curve(cos_deg(85)), .707076, 1e-6);
  EXPECT_FLOAT_EQ(curve(0), 1);
  EXPECT_NEAR(curve.mean(), .238095, 1e-6);
  EXPECT_NEAR((ReflectivityCurve{0.9f, 1, 5}.mean()), .904762, 1e-6);
}

// acceptance: E5
TEST(Fresnel, CurveExponentShapesTheMiddle) {
  for (const float exponent : {0.5f, 1.0f, 2.2f, 5.0f, 8.0f}) {
    const ReflectivityCurve curve{0.1f, 0.7f, exponent};
    EXPECT_FLOAT_EQ(curve(1), 0.1f);
    EXPECT_FLOAT_EQ(curve(0), 0.7f);
    EXPECT_NEAR(curve(0.5f), 0.1 + 0.6 * std::pow(0.5, exponent), 1e-6);
    EXPECT_NEAR(curve.mean(), quadrature_mean(curve), 1e-5);
  }
}

TEST(Fresnel, PaneMatchesTheTable) {
  EXPECT_NEAR(pane_reflectance(fresnel_dielectric(1, 1.5f)), .076923, 1e-6);
  EXPECT_NEAR(pane_reflectance(fresnel_dielectric(cos_deg(60), 1.5f)), .163768, 2e-6);
  EXPECT_NEAR(pane_reflectance(fresnel_dielectric(cos_deg(75), 1.5f)), .403908, 2e-6);
}

}  // namespace fresnel_test
}  // namespace oriel::bsdf
