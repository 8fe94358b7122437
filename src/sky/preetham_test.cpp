// SPDX-License-Identifier: Apache-2.0
// The Preetham sky and sun compared with an independently computed table.
#include "sky/preetham.h"

#include "color/luminance.h"
#include "sky/daylight.h"
#include "support/directions.h"

#include <gtest/gtest.h>

namespace oriel::sky {
namespace preetham_test {

using testing::sky_direction;

constexpr float kDeg = kPi / 180;

void expect_relative(float value, float expected, float tolerance, const char* what) {
  EXPECT_NEAR(value, expected, tolerance * expected) << what;
}

struct Row {
  float turbidity, elevation_deg;
  float red, green, blue, normal_lux, horizontal_lux;  // sun
  float zenith, zenith_x, zenith_y, sky_lux;
};
constexpr Row kTable[] = {
    {2, 10, 43315, 35358, 20066, 35945, 6242, 2457.5f, .25799f, .27083f, 19035},
    {2, 30, 87398, 80868, 62537, 80933, 40467, 3487.3f, .23802f, .24194f, 24190},
    {2, 45, 97918, 92459, 75174, 92372, 65317, 4469.6f, .24096f, .24368f, 25165},
    {2, 60, 102994, 98134, 81586, 97972, 84847, 5886.7f, .25143f, .25589f, 24423},
    {2, 90, 106147, 101684, 85668, 101477, 101477, 15500.7f, .26675f, .27720f, 27361},
    {3, 45, 86524, 80257, 63192, 80357, 56821, 7320.4f, .24569f, .25140f, 28913},
    {5, 30, 51763, 44414, 29983, 44935, 22467, 8187.1f, .25861f, .27230f, 30946},
    {5, 60, 76054, 69368, 53308, 69630, 60301, 18484, .25932f, .26968f, 48357},
    {10, 45, 36396, 29800, 18744, 30404, 21499, 22869, .28614f, .30847f, 67241},
    {17, 45, 15310, 11065, 5559, 11570, 8181, 31614, .33943f, .37085f, 94227},
};

// acceptance: S2
TEST(Sun, NormalIlluminanceMatchesTable) {
  for (const Row& row : kTable) {
    const float sun_z = std::sin(row.elevation_deg * kDeg);
    const Rgb sun = sun_illuminance(sun_z, row.turbidity);
    expect_relative(sun.x, row.red, 1e-3f, "red");
    expect_relative(sun.y, row.green, 1e-3f, "green");
    expect_relative(sun.z, row.blue, 1e-3f, "blue");
    expect_relative(luminance(sun), row.normal_lux, 1e-3f, "normal");
    expect_relative(luminance(sun) * sun_z, row.horizontal_lux, 1e-3f, "horizontal");
  }
}

// acceptance: S2
TEST(Sun, OutsideTheAtmosphereIs127500Lux) {
  EXPECT_NEAR(luminance(sun_illuminance_outside_atmosphere()), 127500, 10);
}

TEST(Sun, ClearDayFollowsIesWithinThreePercent) {
  // IES 1984 clear day, direct normal illuminance; turbidity 2 from 45 degrees up.
  const float ies[][2] = {{45, 94740}, {60, 100046}, {90, 103349}};
  for (const auto& [elevation, lux] : ies)
    expect_relative(luminance(sun_illuminance(std::sin(elevation * kDeg), 2)), lux, 0.026f, "sun");
}

TEST(Sun, IsBlackOnAndBelowTheHorizon) {
  EXPECT_TRUE(is_black(sun_illuminance(0, 2)));
  EXPECT_TRUE(is_black(sun_illuminance(-0.2f, 2)));
  EXPECT_GT(luminance(sun_illuminance(0.001f, 2)), 0);
}

// acceptance: S4
TEST(Sun, HazeDimsAndReddens) {
  for (float elevation : {5.0f, 20.0f, 45.0f, 90.0f}) {
    Rgb previous = sun_illuminance(std::sin(elevation * kDeg), 2);
    for (float turbidity = 2.5f; turbidity <= 17; turbidity += 0.5f) {
      const Rgb sun = sun_illuminance(std::sin(elevation * kDeg), turbidity);
      EXPECT_LT(luminance(sun), luminance(previous));
      EXPECT_GT(sun.x / sun.y, previous.x / previous.y);
      EXPECT_GT(sun.y / sun.z, previous.y / previous.z);
      previous = sun;
    }
  }
}

// acceptance: S3
TEST(Preetham, ZenithMatchesTable) {
  for (const Row& row : kTable) {
    const float angle = (90 - row.elevation_deg) * kDeg;
    expect_relative(zenith_luminance(row.turbidity, angle), row.zenith, 1e-3f, "luminance");
    const Vec2 chromaticity = zenith_chromaticity(row.turbidity, angle);
    EXPECT_NEAR(chromaticity.x, row.zenith_x, 2e-5f);
    EXPECT_NEAR(chromaticity.y, row.zenith_y, 2e-5f);
    // A lookup at the zenith returns the zenith value.
    const auto up =
        PreethamSky(sky_direction(row.elevation_deg, 20), row.turbidity).xyy(Vec3(0, 0, 1));
    expect_relative(up.luminance, row.zenith, 1e-3f, "look-up");
    EXPECT_NEAR(up.x, row.zenith_x, 2e-5f);
    EXPECT_NEAR(up.y, row.zenith_y, 2e-5f);
  }
}

// acceptance: S3
TEST(Preetham, PointSamplesMatchTable) {
  struct Sample {
    float turbidity, elevation_deg, zenith_angle_deg, azimuth_deg, luminance;
  };
  const Sample samples[] = {{2, 45, 45, 180, 4012.13f}, {2, 45, 80, 0, 25919.56f},
                            {2, 45, 80, 90, 12639.49f}, {2, 45, 80, 180, 11859.77f},
                            {3, 45, 80, 0, 17239.70f},  {3, 45, 80, 180, 7653.94f},
                            {5, 30, 80, 0, 20997.14f},  {5, 30, 80, 180, 6116.77f}};
  for (const Sample& s : samples) {
    const PreethamSky sky(sky_direction(s.elevation_deg, 33), s.turbidity);
    const auto c = sky.xyy(sky_direction(90 - s.zenith_angle_deg, 33 + s.azimuth_deg));
    expect_relative(c.luminance, s.luminance, 1e-3f, "luminance");
  }
}

// acceptance: S3
TEST(Preetham, ChromaticityMatchesTable) {
  const Vec3 sun = sky_direction(45, 0);
  const PreethamSky sky(sun, 2);
  EXPECT_NEAR(sky.xyy(sky_direction(45, 180)).y, .23712f, 2e-5f);
  EXPECT_NEAR(sky.xyy(sky_direction(10, 0)).y, .29565f, 3e-5f);
  EXPECT_NEAR(sky.xyy(sky_direction(10, 0)).x, .27915f, 3e-5f);
  const PreethamSky paper(sun, 2, {.paper_chromaticity = true});
  EXPECT_NEAR(paper.xyy(sky_direction(10, 0)).x, .28701f, 3e-5f);
}

// acceptance: S3
TEST(Preetham, HorizontalIlluminanceMatchesTable) {
  for (const Row& row : kTable) {
    const PreethamSky sky(sky_direction(row.elevation_deg, 0), row.turbidity);
    expect_relative(luminance(horizontal_illuminance(sky)), row.sky_lux, 1e-3f, "sky");
  }
}

TEST(Preetham, AntisolarClampHoldsTheHalfSkyAwayFromTheSun) {
  const Vec3 sun = sky_direction(20, 0);
  const PreethamSky open(sun, 2), held(sun, 2, {.clamp_antisolar = true});
  EXPECT_FLOAT_EQ(open.xyy(sky_direction(60, 40)).luminance,
                  held.xyy(sky_direction(60, 40)).luminance);
  EXPECT_NE(open.xyy(sky_direction(20, 180)).luminance, held.xyy(sky_direction(20, 180)).luminance);
}

TEST(Preetham, LookUpsBelowTheHorizonMeetIt) {
  const PreethamSky sky(sky_direction(30, 0), 4);
  const auto at = sky.xyy(normalize(Vec3(0.6f, 0.8f, kLowestSkyZ)));
  const auto below = sky.xyy(Vec3(0.6f, 0.8f, -0.5f));
  EXPECT_NEAR(at.luminance, below.luminance, 1e-3f * at.luminance);
}

TEST(Preetham, RadianceCarriesTheModelsLuminance) {
  const PreethamSky sky(sky_direction(35, 0), 4);
  for (float azimuth = 0; azimuth < 180; azimuth += 15) {
    const Vec3 w = sky_direction(40, azimuth);
    expect_relative(luminance(sky.radiance(w)), sky.xyy(w).luminance, 1e-3f, "luminance");
  }
}

}  // namespace preetham_test
}  // namespace oriel::sky
