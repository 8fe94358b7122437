// SPDX-License-Identifier: Apache-2.0
// The position of the sun compared with published examples.
#include "sky/solar_position.h"

#include <gtest/gtest.h>

namespace oriel::sky {
namespace solar_position_test {

constexpr double kTolerance = 0.003;  // degrees; documented accuracy of the algorithm

TEST(SolarPosition, MatchesTheExampleOfNrelsReport) {
  // Reda and Andreas, table A5.1: 2003-10-17 12:30:30, zone -7, 820 hPa, 11 degrees.
  const auto jd = julian_day("2003-10-17T12:30:30-07:00");
  ASSERT_TRUE(jd);
  EXPECT_NEAR(*jd, 2452930.312847, 1e-6);
  const SolarPosition sun = solar_position(
      *jd, {.latitude = 39.742476, .longitude = -105.1786, .pressure = 820, .temperature = 11});
  EXPECT_NEAR(90 - sun.elevation, 50.11162, kTolerance);
  EXPECT_NEAR(sun.azimuth, 194.34024, kTolerance);
  EXPECT_NEAR(sun.geometric_elevation, 39.872046, kTolerance);
  EXPECT_NEAR(sun.declination, -9.31434, kTolerance);
  EXPECT_NEAR(sun.right_ascension, 202.22741, kTolerance);
}

TEST(SolarPosition, MatchesMeeusExample) {
  // Example 25.b, the exact position of 1992 October 13, 0 h: 13h 13m 30.749s, -7d 47' 1.74".
  const SolarPosition sun = solar_position(2448908.5 - 59.0 / 86400, {});
  EXPECT_NEAR(sun.right_ascension, (13 + 13 / 60.0 + 30.749 / 3600) * 15, kTolerance);
  EXPECT_NEAR(sun.declination, -(7 + 47 / 60.0 + 1.74 / 3600), kTolerance);
}

TEST(SolarPosition, SeasonsBeginWhenAlmanacsSay) {
  // 2026: equinox March 20, 14:46; solstice June 21, 8:25; solstice December 21, 20:50 UT.
  EXPECT_NEAR(solar_position(*julian_day("2026-03-20T14:46Z"), {}).declination, 0, kTolerance);
  EXPECT_NEAR(solar_position(*julian_day("2026-06-21T08:25Z"), {}).right_ascension, 90, kTolerance);
  EXPECT_NEAR(solar_position(*julian_day("2026-12-21T20:50Z"), {}).right_ascension, 270,
              kTolerance);
  EXPECT_NEAR(solar_position(*julian_day("2026-06-21T08:25Z"), {}).declination, 23.436, kTolerance);
}

TEST(SolarPosition, NoonIsSouthInTheNorthAndNorthInTheSouth) {
  // At noon the elevation is 90 degrees minus latitude plus declination.
  const double jd = *julian_day("2026-06-21T12:00Z");
  const SolarPosition north = solar_position(jd, {.latitude = 50}),
                      south = solar_position(jd, {.latitude = -35});
  EXPECT_NEAR(north.azimuth, 180, 1.5);  // the equation of time is half a degree on that day
  EXPECT_NEAR(north.geometric_elevation, 90 - 50 + 23.436, .05);
  EXPECT_LT(std::fabs(std::remainder(south.azimuth, 360)), 1.5);
  EXPECT_NEAR(south.geometric_elevation, 90 - 35 - 23.436, .05);
  const SolarPosition morning = solar_position(*julian_day("2026-06-21T06:00Z"), {.latitude = 50});
  EXPECT_GT(morning.azimuth, 60);
  EXPECT_LT(morning.azimuth, 90);
}

TEST(SolarPosition, AirRaisesTheSunAtTheHorizonByHalfADegree) {
  // Steps through a day: where the geometric elevation is 0, refraction is about 29 minutes of arc.
  const double start = *julian_day("2026-03-20T00:00Z");
  for (int i = 0; i < 24 * 60; ++i) {
    const SolarPosition sun = solar_position(start + i / 1440.0, {.latitude = 48});
    if (std::fabs(sun.geometric_elevation) < .1) {
      EXPECT_NEAR(sun.elevation - sun.geometric_elevation, .48, .03);
    }
    if (sun.geometric_elevation < -1) {
      EXPECT_EQ(sun.elevation, sun.geometric_elevation);
    }
  }
  const SolarPosition vacuum = solar_position(start + .3, {.latitude = 48, .pressure = 0});
  EXPECT_EQ(vacuum.elevation, vacuum.geometric_elevation);
}

TEST(SolarPosition, TimesAreReadWithTheirZone) {
  EXPECT_NEAR(*julian_day("2000-01-01T12:00Z"), 2451545, 1e-9);
  EXPECT_NEAR(*julian_day("2000-01-01 14:30+02:30"), 2451545, 1e-9);
  EXPECT_NEAR(*julian_day("2000-01-01T07:00:30.5-0500"), 2451545 + 30.5 / 86400, 1e-9);
  EXPECT_NEAR(*julian_day("1987-06-19T12:00Z"), 2446966, 1e-9);  // Meeus, chapter 7
  for (const char* wrong :
       {"", "2026-06-21", "2026-06-21T12:00", "2026-02-30T12:00Z", "2026-06-21T12Z",
        "2026-6-21T12:00Z", "2026-06-21T24:00Z", "2026-06-21T12:60Z", "2026-06-21T12:00+2",
        "2026-06-21T12:00Zx", "2026-06-21T12:00:Z", "tomorrow"})
    EXPECT_FALSE(julian_day(wrong)) << wrong;
}

TEST(SolarPosition, DirectionsFollowNorthAndTheAxisThatIsUp) {
  const auto expect = [](const Vec3& d, const Vec3& e) { EXPECT_LT(length(d - e), 1e-6f); };
  expect(direction_to_sun(0, 0, 0, false), Vec3(0, 1, 0));
  expect(direction_to_sun(90, 0, 0, false), Vec3(1, 0, 0));
  expect(direction_to_sun(90, 0, 0, true), Vec3(1, 0, 0));
  expect(direction_to_sun(180, 0, 0, true), Vec3(0, 0, 1));
  expect(direction_to_sun(123, 90, 0, true), Vec3(0, 1, 0));
  expect(direction_to_sun(0, 0, 90, false), Vec3(1, 0, 0));
  expect(direction_to_sun(270, 0, 90, true), Vec3(0, 0, -1));
}

}  // namespace solar_position_test
}  // namespace oriel::sky
