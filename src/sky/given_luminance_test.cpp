// SPDX-License-Identifier: Apache-2.0
// Luminance and illuminance given by the scene (later editions).
#include <gtest/gtest.h>

#include "color/luminance.h"
#include "sky/cie_sky.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"
#include "support/directions.h"

namespace oriel::sky {
namespace given_luminance_test {

using testing::sky_direction;

const Vec3 kUp(0, 0, 1);
/// The CIE clear sky has the Perez form.
constexpr PerezCoefficients kCieClear{-1, -0.32f, 10 / 0.91f, -3, 0.45f / 0.91f};

SkyParameters given(const GivenLuminance& luminance, float elevation = 40) {
  SkyParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.sun_direction = sky_direction(elevation);
  p.luminance = luminance;
  return p;
}

float luminance_at(const SkyParameters& p, const Vec3& d) {
  return luminance(PhysicalSky(p).radiance(d, SkyPart::Gradient)) / kPi;
}

/// Cosine-weighted mean of lookups: the value of a horizontal surface.
float card(const SkyParameters& p) {
  const PhysicalSky sky(p);
  double sum = 0;
  constexpr int kRings = 100, kSectors = 200;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSectors; ++j) {
      const float sin2 = (static_cast<float>(i) + 0.5f) / kRings, r = std::sqrt(sin2);
      const float phi = kTwoPi * (static_cast<float>(j) + 0.5f) / kSectors;
      const Vec3 d(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2));
      sum += luminance(sky.radiance(d, SkyPart::Gradient));
    }
  return static_cast<float>(sum / (kRings * kSectors));
}

TEST(Preetham, GivenCoefficientsDistributeLuminance) {
  const Vec3 sun = sky_direction(35);
  PreethamSky sky(sun, 4);
  const auto before = sky.xyy(kUp);
  const auto colour = sky.xyy(sky_direction(20, 50));
  sky.distribute(kCieClear);
  EXPECT_NEAR(sky.xyy(kUp).luminance, before.luminance, 1e-4f * before.luminance);
  for (const Vec3& d : {sky_direction(80, 40), sky_direction(35, 10), sky_direction(10, 120),
                        sky_direction(3, 180)}) {
    const float expected = before.luminance * cie_clear_relative(d.z, dot(d, sun), sun.z);
    EXPECT_NEAR(sky.xyy(d).luminance, expected, 1e-3f * expected);
  }
  EXPECT_EQ(sky.xyy(sky_direction(20, 50)).x, colour.x);
  EXPECT_EQ(sky.xyy(sky_direction(20, 50)).y, colour.y);
}

TEST(GivenLuminance, ZenithIsMet) {
  for (const PerezCoefficients& form : {PerezCoefficients{}, kCieClear}) {
    const SkyParameters p = given({.zenith = 5000, .distribution = form});
    EXPECT_NEAR(luminance_at(p, kUp), 5000, 10);
  }
}

TEST(GivenLuminance, HorizontalIlluminanceIsMetAndYieldsToTheZenith) {
  for (const PerezCoefficients& form : {PerezCoefficients{}, kCieClear}) {
    GivenLuminance level{.horizontal_illuminance = 15000, .distribution = form};
    for (const float elevation : {5.0f, 40.0f, 80.0f})
      EXPECT_NEAR(card(given(level, elevation)), 15000, 20) << elevation;
    level.zenith = 5000;
    EXPECT_NEAR(luminance_at(given(level), kUp), 5000, 10);
  }
}

TEST(GivenLuminance, WithoutCoefficientsTheHazeDistributes) {
  SkyParameters plain = given({});
  plain.luminance.reset();
  plain.haze = 3;
  SkyParameters scaled = given({.zenith = 1234});
  scaled.haze = 3;
  const float factor = luminance_at(scaled, kUp) / luminance_at(plain, kUp);
  for (const Vec3& d : {sky_direction(60, 30), sky_direction(5, 170)})
    EXPECT_NEAR(luminance_at(scaled, d), factor * luminance_at(plain, d), 1e-3f * factor * 1e4f);
  // Without given luminance they are equal.
  SkyParameters same = given({});
  same.haze = 3;
  EXPECT_FLOAT_EQ(luminance_at(same, sky_direction(20, 9)),
                  luminance_at(plain, sky_direction(20, 9)));
}

TEST(GivenLuminance, GroundIsLitByIt) {
  SkyParameters p = given({.horizontal_illuminance = 30000});
  p.ground_color = Rgb(0.5f);
  const float sun = luminance(sun_illuminance(p.sun_direction.z, 2)) * p.sun_direction.z;
  EXPECT_NEAR(luminance(PhysicalSky(p).ground_radiance()), 0.5f * (30000 + sun), 100);
}

TEST(GivenLuminance, DoesNotFadeAfterSunset) {
  const SkyParameters p = given({.zenith = 800}, -8);
  EXPECT_NEAR(luminance_at(p, kUp), 800, 2);
}

TEST(GivenLuminance, StrangeCoefficientsStayFinite) {
  for (const PerezCoefficients& form :
       {PerezCoefficients{-3, 0, 0, 0, 0}, PerezCoefficients{5, 90, 1, 300, -9},
        PerezCoefficients{1e30f, -1e30f, 1e30f, 1e30f, 1e30f}}) {
    const PhysicalSky sky(given({.horizontal_illuminance = 100, .distribution = form}));
    for (const Vec3& d : {kUp, sky_direction(40), sky_direction(1, 77), sky_direction(-20)}) {
      const Rgb c = sky.radiance(d);
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(c[k]) && c[k] >= 0) << c[k];
    }
  }
}

TEST(Sun, GivenIlluminanceIsMetInTheHazesColour) {
  SunParameters p{.rgb_unit_conversion = Rgb(1), .haze = 4};
  const Rgb plain = sun_colour(p, sky_direction(25));
  p.normal_illuminance = 60000;
  const Rgb fixed = sun_colour(p, sky_direction(25));
  EXPECT_NEAR(luminance(fixed), 60000, 6);
  EXPECT_NEAR(fixed.x / fixed.z, plain.x / plain.z, 1e-4f * plain.x / plain.z);
  EXPECT_NEAR(luminance(sun_colour(p, sky_direction(3))), 60000, 6);
  EXPECT_TRUE(is_black(sun_colour(p, sky_direction(-1))));
  p.normal_illuminance = 0;
  EXPECT_TRUE(is_black(sun_colour(p, sky_direction(25))));
}

}  // namespace given_luminance_test
}  // namespace oriel::sky
