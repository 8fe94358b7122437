// SPDX-License-Identifier: Apache-2.0
// The sun of the physical sky: colour of its light, disc and glow, aerial perspective.
#include "color/luminance.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"
#include "support/directions.h"

#include <gtest/gtest.h>

namespace oriel::sky {
namespace physical_sky_sun_test {

using testing::sky_direction;

constexpr float kDeg = kPi / 180;

SunParameters sun_in_lux(float haze = 0) {
  SunParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.haze = haze;
  return p;
}

SkyParameters sky_in_lux(float elevation_deg) {
  SkyParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.sun_direction = sky_direction(elevation_deg);
  return p;
}

/// A direction at `angle` from the sun, sideways and up.
Vec3 away_from(const Vec3& sun, float angle) {
  const Vec3 side(0, 1, 0);
  return sun * std::cos(angle) + side * std::sin(angle);
}

/// Contribution of disc and glow in direction `d`, in units of the sun's illuminance (green
/// channel).
float added(const SkyParameters& p, const Vec3& d, SkyPart part = SkyPart::Everything) {
  const PhysicalSky sky(p);
  const float sun = sun_illuminance(p.sun_direction.z, 2 + p.haze).y;
  return (sky.radiance(d, part).y - sky.radiance(d, SkyPart::Gradient).y) / sun;
}

// acceptance: S1
TEST(Sun, UnitsScaleItsColour) {
  const Vec3 d = sky_direction(45);
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
    const Rgb c = sun_colour(sun_in_lux(haze), sky_direction(elevation));
    EXPECT_NEAR(c.x, red, 1e-3f * red);
    EXPECT_NEAR(c.z, blue, 1e-3f * blue);
  }
}

// acceptance: S2
TEST(Sun, TracksTheClearDayOfTheIes) {
  // Illuminance by the recommended practice of 1984: 127500 exp(-.21 / sin h), mean distance.
  const float table[][2] = {{45, 94740}, {60, 100046}, {90, 103349}};
  for (const auto& [elevation, lux] : table)
    EXPECT_NEAR(luminance(sun_colour(sun_in_lux(), sky_direction(elevation))), lux, .025f * lux);
}

// acceptance: S6
TEST(Sun, SetsAtTheMovedHorizon) {
  for (float height : {-2.0f, -0.2f, 0.0f, 0.5f, 3.0f}) {
    SunParameters p = sun_in_lux();
    p.horizon_height = height;
    const float horizon_deg = std::asin(height / 10) / kDeg;
    EXPECT_TRUE(is_black(sun_colour(p, sky_direction(horizon_deg - 0.1f)))) << height;
    EXPECT_GT(luminance(sun_colour(p, sky_direction(horizon_deg + 0.1f))), 0) << height;
  }
}

// acceptance: S5
TEST(Sun, TintsAsTheSky) {
  const Vec3 d = sky_direction(20);
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
  const Vec3 d = sky_direction(30);
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
  // At the rim the disc gets darker with haze; the centre is unchanged.
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
  // 15 degrees is z = .26, above the moved horizon .05; at 2 degrees the ground occludes the sun.
  const PhysicalSky up(p);
  EXPECT_GT(up.radiance(p.sun_direction).x, 10 * up.radiance(p.sun_direction, SkyPart::Gradient).x);
  p.sun_direction = sky_direction(2);
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
      // The rim counts as sharp at the nominal radius; the error is a few per cent.
      EXPECT_NEAR(integral, kPi, 0.05 * kPi) << scale << " " << glow;
      EXPECT_NEAR(added(p, p.sun_direction), 100 * factors.disc + 2 * glow * factors.glow,
                  2e-3f * 100 * factors.disc);
    }
  }
}

TEST(PhysicalSky, PhysicallyScaledSunOfTrueSizeIsNearItsLuminance) {
  // A physical disc has pi over its solid angle, 46248 times the sun's illuminance in the pi
  // convention.
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

/// Luminance of glow and sky, without the disc, at an angle beside the sun.
float beside_sun(float haze, float degrees) {
  const float e = 40 * kPi / 180, a = degrees * kPi / 180;
  SkyParameters p;
  p.haze = haze;
  p.sun_direction = Vec3(std::cos(e), 0, std::sin(e));
  // Along the horizon: the elevation, and so the luminance of the rest of the sky, hardly changes.
  const Vec3 aside(0, 1, 0);
  return luminance(PhysicalSky(p).radiance(p.sun_direction * std::cos(a) + aside * std::sin(a),
                                           SkyPart::GradientAndGlow));
}

// "softness of the glow around the sun" (manual 2.4): its falloff is slower with haze. acceptance:
// S4
TEST(Haze, SoftensWhatIsBrightAroundTheSun) {
  for (const float degrees : {5.0f, 10.0f, 15.0f, 25.0f, 35.0f}) {
    float before = 0;
    for (const float haze : {0.0f, 5.0f, 15.0f}) {
      const float kept = beside_sun(haze, degrees) / beside_sun(haze, 1);
      EXPECT_GT(kept, before) << haze << ' ' << degrees;
      before = kept;
      if (std::getenv("ORIEL_FIGURES"))
        std::printf("| haze %g | %g degrees | %.4f of 1 degree |\n", double(haze), double(degrees),
                    double(kept));
    }
  }
}

// Planck's locus by Kim et al., "Design of Advanced Color Temperature Control System for HDTV
// Applications", JKPS 41(6), 2002: xy within .001 from 4000 to 25000 K.
// acceptance: S2
TEST(Sun, ColourOutsideTheAtmosphereIsHistoricOrOf5900Kelvin) {
  const double t = 5900;
  const double x = -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + .2226347e3 / t + .240390;
  const double y = 3.0817580 * x * x * x - 5.8733867 * x * x + 3.75112997 * x - .37001483;
  const auto chromaticity = [](const Rgb& c) {
    // IEC 61966-2-1
    const double xyz[] = {.4124 * c.x + .3576 * c.y + .1805 * c.z,
                          .2126 * c.x + .7152 * c.y + .0722 * c.z,
                          .0193 * c.x + .1192 * c.y + .9505 * c.z};
    const double sum = xyz[0] + xyz[1] + xyz[2];
    return std::pair(xyz[0] / sum, xyz[1] / sum);
  };
  const Rgb manual = sun_illuminance_outside_atmosphere(true);
  EXPECT_NEAR(luminance(manual), 127500, 10);
  EXPECT_NEAR(chromaticity(manual).first, x, .002);
  EXPECT_NEAR(chromaticity(manual).second, y, .002);
  const Rgb historic = sun_illuminance_outside_atmosphere();
  EXPECT_NEAR(historic.y / historic.x, .992f, 1e-6f);
  EXPECT_GT(std::abs(chromaticity(historic).first - x), .004);
  // Sun and sky use the same bit.
  const Vec3 high(0, 0, 1);
  const Rgb a = sun_colour({}, high), b = sun_colour({.as_in_manual = true}, high);
  EXPECT_NEAR(b.z / a.z * a.y / b.y, manual.z / historic.z * historic.y / manual.y, 1e-4f);
}

// A Lambertian ground "lit by the sun and sky only" (manual 2.6), for any haze. acceptance: S7
TEST(Haze, GroundIsLitByThisSunAndSkyAsTheManualSays) {
  for (const float haze : {0.0f, 3.0f, 8.0f}) {
    SkyParameters p;
    p.haze = haze;
    p.sun_direction = normalize(Vec3(1, 0, .8f));
    p.ground_color = Rgb(.3f, .2f, .1f);
    p.as_in_manual = true;
    const PhysicalSky sky(p);
    // Midpoint rule over the upper hemisphere; a lookup returns pi L, so the result is E pi.
    Rgb mean(0);
    constexpr int kRings = 64, kSectors = 128;
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j) {
        const float sin2 = (static_cast<float>(i) + .5f) / kRings, r = std::sqrt(sin2);
        const float phi = kTwoPi * (static_cast<float>(j) + .5f) / kSectors;
        mean += sky.radiance(Vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2)),
                             SkyPart::Gradient) /
                static_cast<float>(kRings * kSectors);
      }
    const Rgb sun = sun_colour({.haze = haze, .as_in_manual = true}, p.sun_direction);
    const Rgb exact = (mean + sun * p.sun_direction.z) * p.ground_color;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sky.ground_radiance()[k] / exact[k], 1, .003f) << haze << ' ' << k;
    p.as_in_manual = false;
    const float port = PhysicalSky(p).ground_radiance().y / exact.y;
    EXPECT_GT(std::abs(port - 1), haze > 5 ? .05f : 0.0f);
  }
}

}  // namespace physical_sky_sun_test
}  // namespace oriel::sky
