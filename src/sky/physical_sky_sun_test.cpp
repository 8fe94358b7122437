// SPDX-License-Identifier: Apache-2.0
// The sun of the physical sky: colour of its light, disc and glow, aerial haze.
#include "color/luminance.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"

#include <gtest/gtest.h>

namespace oriel::sky {
namespace physical_sky_sun_test {

constexpr float kDeg = kPi / 180;

Vec3 elevated(float elevation_deg) {
  return Vec3(std::cos(elevation_deg * kDeg), 0, std::sin(elevation_deg * kDeg));
}

SunParameters sun_in_lux(float haze = 0) {
  SunParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.haze = haze;
  return p;
}

SkyParameters sky_in_lux(float elevation_deg) {
  SkyParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.sun_direction = elevated(elevation_deg);
  return p;
}

/// `angle` away from the sun, sideways from its vertical plane and up.
Vec3 away_from(const Vec3& sun, float angle) {
  const Vec3 side(0, 1, 0);
  return sun * std::cos(angle) + side * std::sin(angle);
}

/// What disc and glow add toward `d`, in units of the sun's illuminance (green channel).
float added(const SkyParameters& p, const Vec3& d, SkyPart part = SkyPart::Everything) {
  const PhysicalSky sky(p);
  const float sun = sun_illuminance(p.sun_direction.z, 2 + p.haze).y;
  return (sky.radiance(d, part).y - sky.radiance(d, SkyPart::Gradient).y) / sun;
}

// acceptance: S1
TEST(Sun, UnitsScaleItsColour) {
  const Vec3 d = elevated(45);
  SunParameters p = sun_in_lux();
  EXPECT_NEAR(luminance(sun_colour(p, d)), 92372, 92);
  p.rgb_unit_conversion = Rgb(0.0f);
  EXPECT_NEAR(luminance(sun_colour(p, d)), 92372.0f / 80000, 1.2e-3f);
  EXPECT_NEAR(luminance(sun_colour(SunParameters(), d)), 9.2372f, 9.3e-3f);
}

// acceptance: S2
TEST(Sun, ColourFollowsHazeAndHeight) {
  const float table[][4] = {{0, 10, 43315, 20066}, {1, 45, 86524, 63192}, {15, 45, 15310, 5559}};
  for (const auto& [haze, elevation, red, blue] : table) {
    const Rgb c = sun_colour(sun_in_lux(haze), elevated(elevation));
    EXPECT_NEAR(c.x, red, 1e-3f * red);
    EXPECT_NEAR(c.z, blue, 1e-3f * blue);
  }
}

// acceptance: S2
TEST(Sun, TracksTheClearDayOfTheIes) {
  // Illuminance by the recommended practice of 1984: 127500 exp(-.21 / sin h), mean distance.
  const float table[][2] = {{45, 94740}, {60, 100046}, {90, 103349}};
  for (const auto& [elevation, lux] : table)
    EXPECT_NEAR(luminance(sun_colour(sun_in_lux(), elevated(elevation))), lux, .025f * lux);
}

// acceptance: S6
TEST(Sun, SetsAtTheMovedHorizon) {
  for (float height : {-2.0f, -0.2f, 0.0f, 0.5f, 3.0f}) {
    SunParameters p = sun_in_lux();
    p.horizon_height = height;
    const float horizon_deg = std::asin(height / 10) / kDeg;
    EXPECT_TRUE(is_black(sun_colour(p, elevated(horizon_deg - 0.1f)))) << height;
    EXPECT_GT(luminance(sun_colour(p, elevated(horizon_deg + 0.1f))), 0) << height;
  }
}

// acceptance: S5
TEST(Sun, TintsAsTheSky) {
  const Vec3 d = elevated(20);
  SunParameters p = sun_in_lux();
  const Rgb neutral = sun_colour(p, d);
  p.redblueshift = 0.3f;
  EXPECT_NEAR(sun_colour(p, d).x, neutral.x * 1.3f, 1);
  EXPECT_NEAR(sun_colour(p, d).z, neutral.z * 0.7f, 1);
  p.redblueshift = 0;
  p.saturation = 0;
  EXPECT_NEAR(sun_colour(p, d).x, luminance(neutral), 1);
  EXPECT_NEAR(sun_colour(p, d).z, luminance(neutral), 1);
}

// acceptance: S15
TEST(Sun, YIsUpOnAndMultiplier) {
  SunParameters p = sun_in_lux();
  const Vec3 d = elevated(30);
  const Rgb one = sun_colour(p, d);
  p.y_is_up = true;
  EXPECT_EQ(sun_colour(p, Vec3(d.x, d.z, d.y)), one);
  p.y_is_up = false;
  p.multiplier = 2;
  EXPECT_NEAR(sun_colour(p, d).y, 2 * one.y, 1e-6f * one.y);
  p.multiplier = 0;
  EXPECT_TRUE(is_black(sun_colour(p, d)));
  p.multiplier = 1;
  p.on = false;
  EXPECT_TRUE(is_black(sun_colour(p, d)));
}

// acceptance: S9
TEST(PhysicalSky, DiscProfileMatchesTable) {
  // Angle over disc radius against the factor of the sun, scale 4, haze 0, both intensities 1.
  const float table[][2] = {{0, 102.0f},      {0.5f, 101.28f}, {1, 48.575f}, {1.2f, 21.525f},
                            {1.5f, 1.22825f}, {2, 1.024f},     {5, 0.25f},   {10.1f, 0}};
  const SkyParameters p = sky_in_lux(45);
  const float radius = 4 * kSunAngularRadius;
  for (const auto& [ratio, factor] : table) {
    const float value = added(p, away_from(p.sun_direction, ratio * radius));
    EXPECT_NEAR(value, factor, 1e-3f * factor + 1e-5f) << ratio;
  }
}

// acceptance: S9
TEST(PhysicalSky, PartsSeeOnlyTheirShareOfTheSun) {
  const SkyParameters p = sky_in_lux(45);
  EXPECT_NEAR(added(p, p.sun_direction, SkyPart::GradientAndGlow), 2, 2e-3f);
  EXPECT_NEAR(added(p, p.sun_direction, SkyPart::Everything), 102, 0.1f);
}

// acceptance: S9
TEST(PhysicalSky, IntensitiesScaleDiscAndGlowApart) {
  SkyParameters p = sky_in_lux(45);
  p.sun_disk_intensity = 3;
  p.sun_glow_intensity = 0.5f;
  EXPECT_NEAR(added(p, p.sun_direction), 301, 0.3f);
  p.sun_disk_intensity = 0;
  EXPECT_NEAR(added(p, p.sun_direction), 1, 2e-3f);
  p.sun_disk_scale = 0;
  EXPECT_EQ(added(p, p.sun_direction), 0);
}

// acceptance: S9
TEST(PhysicalSky, DiscSettingsLeaveTheGradientAlone) {
  SkyParameters plain = sky_in_lux(45), loud = plain;
  loud.sun_disk_intensity = 50;
  loud.sun_glow_intensity = 50;
  loud.sun_disk_scale = 20;
  const PhysicalSky a(plain), b(loud);
  for (float angle = 0; angle < 1; angle += 0.01f) {
    const Vec3 d = away_from(plain.sun_direction, angle);
    EXPECT_EQ(a.radiance(d, SkyPart::Gradient), b.radiance(d, SkyPart::Gradient));
  }
}

// acceptance: S4
TEST(PhysicalSky, HazeSoftensTheDiscsEdge) {
  // Inside the rim the disc darkens as haze grows; the middle stays.
  float previous = 1e9f;
  for (float haze = 0; haze <= 15; haze += 3) {
    SkyParameters p = sky_in_lux(45);
    p.haze = haze;
    const float rim = added(p, away_from(p.sun_direction, 0.9f * 4 * kSunAngularRadius));
    EXPECT_LT(rim, previous) << haze;
    EXPECT_NEAR(added(p, p.sun_direction), 102, 0.2f) << haze;
    previous = rim;
  }
}

TEST(PhysicalSky, DiscSinksWithTheMovedHorizon) {
  SkyParameters p = sky_in_lux(15);
  p.horizon_height = 0.5f;
  p.horizon_blur = 0;
  // 15 degrees is z = .26, above the moved horizon .05; at 2 degrees the ground hides the sun.
  const PhysicalSky up(p);
  EXPECT_GT(up.radiance(p.sun_direction).x, 10 * up.radiance(p.sun_direction, SkyPart::Gradient).x);
  p.sun_direction = elevated(2);
  const PhysicalSky down(p);
  EXPECT_EQ(down.radiance(p.sun_direction), down.ground_radiance());
}

TEST(PhysicalSky, NothingShinesBeyondTheGlowRadius) {
  const SkyParameters p = sky_in_lux(45);
  const PhysicalSky sky(p);
  EXPECT_NEAR(std::acos(sky.cos_glow_radius()), 40 * kSunAngularRadius, 1e-5f);
  EXPECT_GT(added(p, away_from(p.sun_direction, 39 * kSunAngularRadius)), 0);
  EXPECT_EQ(added(p, away_from(p.sun_direction, 41 * kSunAngularRadius)), 0);
}

TEST(PhysicalSky, PhysicallyScaledSunCarriesTheSunsEnergy) {
  // In the pi convention the integral of the factor over solid angle is pi times the intensity.
  for (float scale : {1.0f, 4.0f, 10.0f}) {
    for (float glow : {0.0f, 1.0f, 30.0f}) {
      SkyParameters p = sky_in_lux(45);
      p.physically_scaled_sun = true;
      p.sun_disk_scale = scale;
      p.sun_glow_intensity = glow;
      const DiscScale factors = physical_disc_scale(scale, 1, glow);
      const float edge = disc_softness_end(0);
      const double reach = 10 * kSunAngularRadius * scale;
      constexpr int kSteps = 20000;
      double integral = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        const float f = static_cast<float>(1 - t);
        const double factor =
            glow * factors.glow * glow_profile(f) + factors.disc * disc_profile(f, edge);
        integral += factor * kTwoPi * std::sin(t * reach) * reach / kSteps;
      }
      // The rim counts as sharp at the nominal radius, which is good to a few per cent.
      EXPECT_NEAR(integral, kPi, 0.05 * kPi) << scale << " " << glow;
      EXPECT_NEAR(added(p, p.sun_direction), 100 * factors.disc + 2 * glow * factors.glow,
                  2e-3f * 100 * factors.disc);
    }
  }
}

TEST(PhysicalSky, PhysicallyScaledSunOfTrueSizeIsNearItsLuminance) {
  // A true disc is pi over its solid angle, 46248 times the sun's illuminance in the pi convention.
  EXPECT_NEAR(physical_disc_scale(1, 1, 0).disc * 100, 46248, 5);
}

// acceptance: S4
TEST(Sun, HazeSoftensItsShadows) {
  EXPECT_EQ(sun_cone_angle(1, 0), kSunAngularRadius);
  EXPECT_FLOAT_EQ(sun_cone_angle(3, 0), 3 * kSunAngularRadius);
  EXPECT_EQ(sun_cone_angle(0, 8), 0);
  for (float haze = 0; haze < 15; ++haze)
    EXPECT_LT(sun_cone_angle(1, haze), sun_cone_angle(1, haze + 1));
}

// acceptance: S12
TEST(AerialPerspective, IsTenPercentAtTheVisibilityDistance) {
  EXPECT_NEAR(aerial_haze(300, 300, 0), 0.1f, 1e-6f);
  EXPECT_NEAR(aerial_haze(600, 300, 0), 0.19f, 1e-6f);
  EXPECT_EQ(aerial_haze(0, 300, 0), 0);
  EXPECT_EQ(aerial_haze(300, 0, 0), 0);
  EXPECT_EQ(aerial_haze(INFINITY, 300, 0), 1);
}

// acceptance: S4
TEST(AerialPerspective, GrowsWithHazeAndDistance) {
  for (float haze = 0; haze < 15; ++haze) {
    EXPECT_LT(aerial_haze(100, 1000, haze), aerial_haze(100, 1000, haze + 1));
    EXPECT_LT(aerial_haze(100, 1000, haze), aerial_haze(110, 1000, haze));
  }
}

}  // namespace physical_sky_sun_test
}  // namespace oriel::sky
