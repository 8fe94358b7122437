// SPDX-License-Identifier: Apache-2.0
// Luminance weights, sRGB and black bodies compared with published values.
#include "color/black_body.h"
#include "color/luminance.h"
#include "color/srgb.h"

#include <gtest/gtest.h>

namespace oriel {
namespace color_test {

TEST(Luminance, WeightsSumToOne) {
  for (const Rgb& w : {kRec709Luminance, kNtscLuminance}) EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-6f);
}

TEST(Luminance, GreyIsItsOwnLuminance) {
  EXPECT_NEAR(luminance(Rgb(0.37f)), 0.37f, 1e-6f);
  EXPECT_NEAR(luminance(Rgb(0.37f), kNtscLuminance), 0.37f, 1e-6f);
}

TEST(Luminance, DefaultIsRec709) {
  const Rgb c(0.3f, 0.5f, 0.9f);
  EXPECT_FLOAT_EQ(luminance(c), luminance(c, kRec709Luminance));
  EXPECT_FLOAT_EQ(luminance(Rgb(1, 0.992f, 0.911f)), 0.9878526f);
}

TEST(Srgb, WhiteIsD65) {
  const Vec3 white = linear_srgb_to_xyz(Rgb(1));
  const float sum = white.x + white.y + white.z;
  EXPECT_NEAR(white.y, 1, 1e-5f);
  EXPECT_NEAR(white.x / sum, 0.3127f, 2e-5f);
  EXPECT_NEAR(white.y / sum, 0.3290f, 2e-5f);
}

TEST(Srgb, RedPrimaryHasItsChromaticity) {
  const Vec3 red = linear_srgb_to_xyz(Rgb(1, 0, 0));
  const float sum = red.x + red.y + red.z;
  EXPECT_NEAR(red.x / sum, 0.64f, 1e-5f);
  EXPECT_NEAR(red.y / sum, 0.33f, 1e-5f);
}

TEST(Srgb, XyzRoundTripIsIdentity) {
  const Vec3 xyz(0.2f, 0.35f, 0.8f);
  const Vec3 back = linear_srgb_to_xyz(xyz_to_linear_srgb(xyz));
  EXPECT_LT(length(back - xyz), 2e-6f);
}

TEST(Srgb, MidGreyEncodesTo0461) {
  EXPECT_NEAR(srgb_encode(0.18f), 0.461356f, 1e-6f);
  EXPECT_EQ(srgb_encode(0.0f), 0.0f);
  EXPECT_NEAR(srgb_encode(1.0f), 1.0f, 1e-6f);
}

TEST(Srgb, TransferRoundTripIsIdentity) {
  for (float v = -0.5f; v < 4; v += 0.0137f) EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 3e-6f);
}

struct BlackBodyRow {
  float kelvin, x, y, green, blue, efficacy;
};
constexpr BlackBodyRow kBlackBodies[] = {{2856, .4464f, .4085f, .4552f, .1272f, 16.5f},
                                         {5000, .3449f, .3519f, .7954f, .6300f, 81.4f},
                                         {5900, .3239f, .3337f, .8916f, .8526f, 93.1f},
                                         {6500, .3135f, .3237f, .9445f, .9931f, 95.4f}};

TEST(BlackBody, ChromaticityMatchesTable) {
  for (const BlackBodyRow& row : kBlackBodies) {
    const Vec3 xyz = black_body_xyz(row.kelvin);
    const float sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, row.x, 3e-4f) << row.kelvin;
    EXPECT_NEAR(xyz.y / sum, row.y, 3e-4f) << row.kelvin;
    EXPECT_NEAR(black_body_efficacy(row.kelvin), row.efficacy, 0.1f) << row.kelvin;
  }
}

TEST(BlackBody, SpectrumPeaksWhereWienSays) {
  // Wien: 2.897772e-3 m K / T; the value there is 4.09567e-6 T^5 W m^-2 sr^-1 per metre.
  for (const double kelvin : {2000.0, 5778.0}) {
    const double peak = 2.897772e6 / kelvin;
    const double value = black_body_spectral_radiance(peak, kelvin);
    EXPECT_NEAR(value / (4.09567e-15 * std::pow(kelvin, 5)), 1, 1e-5);
    EXPECT_LT(black_body_spectral_radiance(.99 * peak, kelvin), value);
    EXPECT_LT(black_body_spectral_radiance(1.01 * peak, kelvin), value);
  }
}

TEST(BlackBody, RadianceIsTheIntegralOfTheSpectrum) {
  double sum = 0;  // trapezoid rule in steps of 10 nm, up to 1 mm
  for (int nm = 10; nm <= 1000000; nm += 10) sum += black_body_spectral_radiance(nm, 3000) * 10;
  EXPECT_NEAR(sum / black_body_radiance(3000), 1, 1e-4);
}

TEST(BlackBody, ThatIsColdIsDark) {
  EXPECT_EQ(black_body_radiance(0), 0);
  EXPECT_EQ(black_body_spectral_radiance(500, -1), 0);
  EXPECT_EQ(black_body_spectral_radiance(0, 3000), 0);
}

TEST(BlackBody, ColorMatchesTable) {
  // The tolerance covers the error of the fits; range and step of the integral alone contribute
  // 2e-3.
  for (const BlackBodyRow& row : kBlackBodies) {
    const Rgb c = black_body_color(row.kelvin);
    EXPECT_FLOAT_EQ(c.x, 1) << row.kelvin;
    EXPECT_NEAR(c.y, row.green, 4e-3f) << row.kelvin;
    EXPECT_NEAR(c.z, row.blue, 4e-3f) << row.kelvin;
  }
}

TEST(BlackBody, ChromaticityIsNearCieIlluminantA) {
  // The fits are within about 1 % of CIE A (2856 K), x = .44757, y = .40745.
  const Vec3 xyz = black_body_xyz(2856);
  EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), 0.44757f, 0.0045f);
  EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), 0.40745f, 0.0041f);
}

TEST(BlackBody, SunDiscGivesItsIlluminance) {
  // A disc of angular radius 0.00465 rad: E = pi L sin^2(r); 138 klx at 5900 K, 126 klx at 5778 K.
  const float sin2 = sqr(std::sin(0.00465f));
  EXPECT_NEAR(kPi * black_body_xyz(5900).y * sin2, 138e3f, 1.5e3f);
  EXPECT_NEAR(kPi * black_body_xyz(5778).y * sin2, 126e3f, 1.5e3f);
}

TEST(BlackBody, IsFiniteAtTheEdges) {
  for (float kelvin : {100.0f, 800.0f, 40000.0f}) {
    const Rgb c = black_body_color(kelvin);
    EXPECT_TRUE(is_finite(c)) << kelvin;
    EXPECT_FLOAT_EQ(max_component(c), 1) << kelvin;
  }
}

}  // namespace color_test
}  // namespace oriel
