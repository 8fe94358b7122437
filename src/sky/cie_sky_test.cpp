// SPDX-License-Identifier: Apache-2.0
// The CIE skies against closed forms and published integrals.
#include "sky/cie_sky.h"

#include <gtest/gtest.h>

#include "sky/units.h"
#include "support/directions.h"

namespace oriel::sky {
namespace cie_sky_test {

using testing::sky_direction;

constexpr float kDeg = kPi / 180;

/// Illuminance of a plane by numerical integration over the sphere.
float illuminance(const CieSky& sky, const Vec3& normal) {
  double sum = 0;
  constexpr int kRows = 400, kColumns = 400;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const float z = (static_cast<float>(i) + 0.5f) / kRows, r = std::sqrt(1 - z * z);
      const float phi = kTwoPi * (static_cast<float>(j) + 0.5f) / kColumns;
      const Vec3 d(r * std::cos(phi), r * std::sin(phi), z);
      sum += sky.luminance(d) * std::max(0.0f, dot(d, normal));
    }
  return static_cast<float>(sum * kTwoPi / (kRows * kColumns));
}

TEST(CieSky, ClearSkyLightsAPlaneAsIntegrated) {
  const float table[][2] = {{10, 7.2299f}, {20, 7.0524f}, {30, 6.3944f},
                            {45, 4.8486f}, {60, 3.1905f}, {75, 1.8504f}};
  for (const auto& [elevation, ratio] : table) {
    EXPECT_NEAR(cie_clear_horizontal(std::sin(elevation * kDeg)), ratio, 1e-3f * ratio);
    const CieSky sky({.zenith_luminance = 1, .sun_direction = sky_direction(elevation)});
    EXPECT_NEAR(illuminance(sky, Vec3(0, 0, 1)), ratio, 2e-3f * ratio) << elevation;
  }
}

TEST(CieSky, OvercastSkyLightsPlanesAsTheClosedFormsSay) {
  const CieSky sky({.zenith_luminance = 1000, .overcast = 1});
  EXPECT_NEAR(illuminance(sky, Vec3(0, 0, 1)), 2443.461f, 1e-3f * 2443);
  EXPECT_NEAR(illuminance(sky, Vec3(1, 0, 0)), .396177f * 2443.461f, 1e-3f * 968);
  EXPECT_NEAR(sky.luminance(sky_direction(90)), 1000, 1e-3f);
  EXPECT_NEAR(sky.luminance(sky_direction(.001f)), 333.34f, .1f);
  EXPECT_EQ(sky.luminance(sky_direction(-.001f)), 0);
}

TEST(CieSky, GivenLuminanceOrIlluminanceIsMet) {
  for (const float overcast : {0.0f, 0.3f, 1.0f}) {
    CieParameters p{
        .zenith_luminance = 2500, .overcast = overcast, .sun_direction = sky_direction(35)};
    EXPECT_NEAR(CieSky(p).luminance(Vec3(0, 0, 1)), 2500, .1f);
    p.zenith_luminance = 0;
    p.diffuse_horizontal_illuminance = 12000;
    EXPECT_NEAR(illuminance(CieSky(p), Vec3(0, 0, 1)), 12000, 24) << overcast;
    // The zenith luminance has priority.
    p.zenith_luminance = 2500;
    EXPECT_NEAR(CieSky(p).luminance(Vec3(0, 0, 1)), 2500, .1f);
  }
}

TEST(CieSky, OvercastMixesInAStraightLine) {
  CieParameters p{.sun_direction = sky_direction(50)};
  const auto at = [&](float overcast, const Vec3& d) {
    p.overcast = overcast;
    return CieSky(p).luminance(d);
  };
  for (const Vec3& d : {sky_direction(80, 30), sky_direction(20, 170), sky_direction(50, 3)}) {
    const float clear = at(0, d), cloudy = at(1, d);
    EXPECT_NEAR(at(.25f, d), .75f * clear + .25f * cloudy, 1e-4f * (clear + cloudy));
  }
}

TEST(CieSky, AutomaticLuminanceFollowsTheSunsHeight) {
  // (1.376 * 2.45 - 1.81) tan 45 + .38 = 1.9412; 8.6 sin 45 + .123 = 6.204118.
  EXPECT_NEAR(cie_clear_zenith(std::sin(45 * kDeg)), 1941.2f, .2f);
  EXPECT_NEAR(cie_overcast_zenith(std::sin(45 * kDeg)), 6204.12f, .5f);
  EXPECT_NEAR(cie_clear_zenith(1), cie_clear_zenith(std::sin(87 * kDeg)), 100);
  // The overcast horizontal illuminance is that of the IES curve, 300 + 21000 sin h.
  for (const float h : {10.0f, 30.0f, 60.0f})
    EXPECT_NEAR(cie_overcast_zenith(std::sin(h * kDeg)) * kCieOvercastHorizontal,
                300 + 21000 * std::sin(h * kDeg), 20);
  EXPECT_EQ(CieSky({.sun_direction = sky_direction(-19)}).luminance(Vec3(0, 0, 1)), 0);
  EXPECT_GT(CieSky({.sun_direction = sky_direction(-5)}).luminance(Vec3(0, 0, 1)), 0);
}

TEST(CieSky, ValuesAreInScenesUnits) {
  CieParameters p{.rgb_unit_conversion = Rgb(1), .zenith_luminance = 1000};
  EXPECT_NEAR(CieSky(p).radiance(Vec3(0, 0, 1)).y, 3141.593f, 1);
  p.rgb_unit_conversion = Rgb(0.0f);
  EXPECT_NEAR(CieSky(p).radiance(Vec3(0, 0, 1)).y, 3141.593f / kSunnyDayLux, 1e-5f);
  p.auto_luminance = false;
  p.zenith_luminance = 0;
  EXPECT_TRUE(is_black(CieSky(p).radiance(Vec3(0, 0, 1))));
  EXPECT_TRUE(is_black(CieSky({.on = false}).radiance(Vec3(0, 0, 1))));
}

TEST(CieSky, YIsUpTurnsIt) {
  CieParameters p{.sun_direction = sky_direction(30, 20)};
  const CieSky z(p);
  p.y_is_up = true;
  p.sun_direction = Vec3(p.sun_direction.x, p.sun_direction.z, p.sun_direction.y);
  const CieSky y(p);
  const Vec3 d = sky_direction(40, 70);
  EXPECT_FLOAT_EQ(y.luminance(Vec3(d.x, d.z, d.y)), z.luminance(d));
}

}  // namespace cie_sky_test
}  // namespace oriel::sky
