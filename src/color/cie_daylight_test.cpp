// SPDX-License-Identifier: Apache-2.0
#include "color/cie_daylight.h"

#include <gtest/gtest.h>

#include "color/luminance.h"

namespace oriel {
namespace cie_daylight_test {

TEST(CieDaylight, IsD65At6504Kelvin) {
  const Vec2 xy = cie_daylight_chromaticity(6504);
  EXPECT_NEAR(xy.x, 0.3127, 1e-4);
  EXPECT_NEAR(xy.y, 0.3290, 2e-4);
  const Rgb c = cie_daylight_color(6504);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], 1, 3e-3);
}

TEST(CieDaylight, MatchesTheIlluminantsD50D55D75) {
  // CIE 15:2004, table T.3; nominal temperatures in the current temperature scale.
  const float table[][3] = {{5003, .3457f, .3585f}, {5503, .3325f, .3476f}, {7504, .2991f, .3149f}};
  for (const auto& row : table) {
    const Vec2 xy = cie_daylight_chromaticity(row[0]);
    EXPECT_NEAR(xy.x, row[1], 2e-4) << row[0];
    EXPECT_NEAR(xy.y, row[2], 2e-4) << row[0];
  }
}

TEST(CieDaylight, HasLuminanceOneFromWarmToBlue) {
  for (const float kelvin : {1000.f, 4000.f, 7000.f, 7001.f, 12000.f, 25000.f, 1e6f})
    EXPECT_NEAR(luminance(cie_daylight_color(kelvin)), 1, 1e-5) << kelvin;
  EXPECT_GT(cie_daylight_color(4500).x, cie_daylight_color(4500).z);
  EXPECT_LT(cie_daylight_color(12000).x, cie_daylight_color(12000).z);
  EXPECT_NEAR(cie_daylight_color(7000).z, cie_daylight_color(7001).z, 1e-3);
}

}  // namespace cie_daylight_test
}  // namespace oriel
