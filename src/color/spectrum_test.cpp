// SPDX-License-Identifier: Apache-2.0
#include "color/spectrum.h"

#include <gtest/gtest.h>

#include "color/black_body.h"
#include "color/cie_daylight.h"
#include "color/srgb.h"

namespace oriel {
namespace spectrum_test {

TEST(Spectrum, AFlatOneHasLuminanceOneAndTheWhiteOfE) {
  Spectrum flat;
  flat.fill(1);
  const Vec3 xyz = spectrum_xyz(flat);
  EXPECT_NEAR(xyz.y, 1, 1e-5f);
  // x = y = 1/3; the matching functions are approximations, and 31 bands end at 400 and 700 nm.
  EXPECT_NEAR(xyz.x, 1, .01f);
  EXPECT_NEAR(xyz.z, 1, .015f);
}

TEST(Spectrum, DaylightIsTheTableOfD65) {
  // CIE 15:2004, table T.1.
  const Spectrum d65 = daylight_spectrum(6504);
  EXPECT_NEAR(d65[0], 82.7549f, .1f);
  EXPECT_NEAR(d65[5], 117.008f, .1f);
  EXPECT_NEAR(d65[10], 109.354f, .1f);
  EXPECT_NEAR(d65[16], 100.0f, .001f);
  EXPECT_NEAR(d65[20], 90.0062f, .1f);
  EXPECT_NEAR(d65[25], 80.0268f, .1f);
  EXPECT_NEAR(d65[30], 71.6091f, .1f);
}

TEST(Spectrum, LampsHaveTheirChromaticity) {
  const auto x_y = [](const Spectrum& s) {
    const Vec3 xyz = spectrum_xyz(s);
    return Vec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
  };
  // CIE illuminant A, a black body of 2856 K, and D65.
  EXPECT_NEAR(x_y(black_body_spectrum(2856)).x, .4476f, .003f);
  EXPECT_NEAR(x_y(black_body_spectrum(2856)).y, .4074f, .003f);
  EXPECT_NEAR(x_y(daylight_spectrum(6504)).x, .3127f, .002f);
  EXPECT_NEAR(x_y(daylight_spectrum(6504)).y, .3290f, .002f);
}

TEST(Spectrum, BlackBodiesHaveThatOfPlanck) {
  // Wien's limit: at 1000 K the ratio of two bands is (l1/l2)^5 exp(c2/T (1/l1 - 1/l2)).
  const Spectrum s = black_body_spectrum(1000);
  EXPECT_NEAR(s[30] / s[20],
              std::pow(600.0 / 700, 5) * std::exp(14387.769 * (1 / .6 - 1 / .7) / 1000), .002);
  EXPECT_EQ(black_body_spectrum(10)[0], 0);
  EXPECT_EQ(black_body_spectrum(289)[30], 0);
  const double ratio =
      black_body_spectral_radiance(700, 300) / black_body_spectral_radiance(560, 300);
  EXPECT_NEAR(black_body_spectrum(300)[30] / ratio, 1, 1e-5);
  EXPECT_EQ(black_body_spectrum(300)[16], 1);
}

TEST(Spectrum, SmoothSpectraHaveTheirColour) {
  for (const Rgb& c :
       {Rgb(1, 1, 1), Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(.2f, .5f, .7f)}) {
    const Rgb back = xyz_to_linear_srgb(spectrum_xyz(smooth_spectrum(linear_srgb_to_xyz(c))));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], c[i], 1e-4f);
  }
}

TEST(Spectrum, TheSmoothestOneOfFlatLightIsFlat) {
  Spectrum flat;
  flat.fill(1);
  for (const float band : smooth_spectrum(spectrum_xyz(flat))) EXPECT_NEAR(band, 1, 1e-4f);
}

TEST(Spectrum, BandsAreCentredOnTheirWavelengths) {
  EXPECT_EQ(spectrum_band(400), 0);
  EXPECT_EQ(spectrum_band(554.9f), 15);
  EXPECT_EQ(spectrum_band(555.1f), 16);
  EXPECT_EQ(spectrum_band(700), 30);
  EXPECT_EQ(spectrum_band(394), -1);
  EXPECT_EQ(spectrum_band(706), -1);
}

TEST(Spectrum, ScalingSetsTheLuminance) {
  EXPECT_NEAR(spectrum_xyz(with_luminance(black_body_spectrum(3000), 7)).y, 7, 1e-4f);
  EXPECT_EQ(with_luminance(Spectrum{}, 7)[3], 0);
}

// Chromaticities of CIE 15:2004, table T.3; 31 bands of 10 nm are within .002.
TEST(Spectrum, IlluminantsAreThoseOfTheCie) {
  constexpr struct {
    const char* name;
    float x, y;
  } kTable[] = {{"A", .4476f, .4074f},   {"D50", .3457f, .3585f}, {"D55", .3324f, .3474f},
                {"D65", .3127f, .3290f}, {"D75", .2990f, .3149f}, {"E", 1 / 3.0f, 1 / 3.0f}};
  for (const auto& row : kTable) {
    const std::optional<Spectrum> spectrum = cie_illuminant(row.name);
    ASSERT_TRUE(spectrum) << row.name;
    const Vec3 xyz = spectrum_xyz(*spectrum);
    const float sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, row.x, .002f) << row.name;
    EXPECT_NEAR(xyz.y / sum, row.y, .002f) << row.name;
  }
  EXPECT_FALSE(cie_illuminant("F2"));
}

}  // namespace spectrum_test
}  // namespace oriel
