// SPDX-License-Identifier: Apache-2.0
// Oren-Nayar, translucency and the Phong highlight.
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/translucency.h"
#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace diffuse_test {

using testing::polar_direction;

/// Integral over azimuth (with a kink a quarter turn from the viewer) and sin^2.
double quadrature_albedo(const OrenNayar& lobe, const Vec3& wo) {
  double sum = 0;
  const double kink = std::atan2(double{wo.y}, double{wo.x}) + M_PI / 2;
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int band = 0; band < 8; ++band)
      sum += testing::integrate(
          [&](double v, double phi) {
            const double s = std::sqrt(v), c = std::sqrt(1 - v);
            const Vec3 wi(static_cast<float>(s * std::cos(phi)),
                          static_cast<float>(s * std::sin(phi)), static_cast<float>(c));
            return lobe.eval(wo, wi) / (2 * c);
          },
          band / 8.0, (band + 1) / 8.0, kink + quarter * M_PI / 2, kink + (quarter + 1) * M_PI / 2,
          1e-7);
  return sum;
}

// acceptance: D1
TEST(OrenNayar, RoughnessZeroIsExactlyLambert) {
  const OrenNayar lobe(0);
  for (double to = 0; to < 90; to += 13)
    for (double ti = 1; ti < 90; ti += 11) {
      const Vec3 wi = polar_direction(ti, 40);
      EXPECT_EQ(lobe.eval(polar_direction(to), wi), wi.z * kInvPi);
    }
}

// acceptance: D1
TEST(OrenNayar, CoefficientsMatchThePublishedModel) {
  EXPECT_NEAR(OrenNayar(0.5f).a(), .784483, 1e-6);
  EXPECT_NEAR(OrenNayar(0.5f).b(), .330882, 1e-6);
  EXPECT_NEAR(OrenNayar(1).a(), .624060, 1e-6);
  EXPECT_NEAR(OrenNayar(1).b(), .412844, 1e-6);
}

// acceptance: D1
TEST(OrenNayar, AlbedoMatchesTheClosedForm) {
  const OrenNayar half(0.5f);
  EXPECT_NEAR(half.albedo(1), .78448, 1e-5);
  EXPECT_NEAR(half.albedo(polar_direction(60).z), .88313, 1e-5);
  EXPECT_NEAR(half.albedo(polar_direction(85).z), .94031, 2e-4);  // a coarser quadrature's figure
  for (const float sigma : {0.1f, 0.25f, 0.5f, 1.0f})
    for (const double theta : {0.0, 30.0, 60.0, 80.0, 88.0}) {
      const OrenNayar lobe(sigma);
      const Vec3 wo = polar_direction(theta, 20);
      EXPECT_NEAR(quadrature_albedo(lobe, wo), lobe.albedo(wo.z), 1e-5) << sigma << ' ' << theta;
    }
  // The published model at 0.25 rad and 85 degrees reflects 1.00724; the lobe is divided by that
  // excess.
  const double a = 1 - .5 * .0625 / (.0625 + .33), b = .45 * .0625 / (.0625 + .09);
  EXPECT_NEAR(OrenNayar(0.25f).albedo(polar_direction(85).z) * (a + b / 2), 1.00724, 2e-4);
}

TEST(OrenNayar, NeverReflectsMoreThanItReceives) {
  for (float sigma = 0; sigma < 2; sigma += 0.01f)
    for (float c = 0.0005f; c <= 1; c += 0.01f)
      ASSERT_LE(OrenNayar(sigma).albedo(c), 1.00001f) << sigma << ' ' << c;
}

// acceptance: D1
TEST(OrenNayar, FlatLitSphereIsFlatterThanLambert) {
  // Lit from the viewer: Lambert falls off with the cosine, a rough sphere stays bright to its rim.
  const OrenNayar lobe(1);
  for (const double theta : {30.0, 60.0, 80.0}) {
    const Vec3 w = polar_direction(theta);
    const double s = std::sin(theta * M_PI / 180),
                 expected = (.624060 + .412844 * s * s / w.z) * w.z;
    EXPECT_NEAR(lobe.eval(w, w) * kPi, expected, 1e-5);
    EXPECT_GT(lobe.eval(w, w) / lobe.eval(polar_direction(0), polar_direction(0)), w.z);
  }
}

TEST(Translucency, IsLambertOnTheOtherSide) {
  const Translucency lobe;
  const Vec3 wo = polar_direction(35, 10);
  EXPECT_FLOAT_EQ(lobe.eval(wo, Vec3(0, 0, -1)), kInvPi);
  EXPECT_FLOAT_EQ(lobe.eval(wo, -polar_direction(60)), 0.5f * kInvPi);
  EXPECT_EQ(lobe.eval(wo, polar_direction(60)), 0);
}

TEST(Phong, IsTheBareCosinePower) {
  const PhongHighlight lobe{20};
  EXPECT_FLOAT_EQ(lobe.eval(polar_direction(40), polar_direction(40, 180)), kInvPi);
  EXPECT_NEAR(lobe.eval(polar_direction(40), polar_direction(70, 180)) * kPi,
              std::pow(std::cos(M_PI / 6), 20), 1e-6);
  EXPECT_EQ(lobe.eval(polar_direction(80), polar_direction(80)), 0);
  EXPECT_EQ(lobe.eval(polar_direction(40), -polar_direction(40)), 0);
}

// The half vector of the viewer at 40 degrees and a light at 0 is 20 degrees from the normal.
TEST(BlinnPhong, IsThePowerOfTheHalfVectorsCosine) {
  EXPECT_NEAR(blinn_phong(polar_direction(40), polar_direction(40, 180), 20), 1, 1e-5);
  EXPECT_NEAR(blinn_phong(polar_direction(40), Vec3(0, 0, 1), 10), std::pow(std::cos(M_PI / 9), 10),
              1e-5);
  EXPECT_EQ(blinn_phong(polar_direction(40), -polar_direction(40), 10), 0);
}

}  // namespace diffuse_test
}  // namespace oriel::bsdf
