// SPDX-License-Identifier: Apache-2.0
// Parameters of the physical sky: units, tint, horizon, ground, night, axes; results are finite and
// non-negative.
#include "sky/physical_sky.h"

#include "base/frame.h"
#include "color/luminance.h"
#include "sky/daylight.h"
#include "support/directions.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel::sky {
namespace physical_sky_test {

using testing::sky_direction;

constexpr float kDeg = kPi / 180;

SkyParameters in_lux(float elevation_deg, float haze = 0) {
  SkyParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.haze = haze;
  p.sun_direction = sky_direction(elevation_deg, 0);
  return p;
}

Rgb gradient(const SkyParameters& p, const Vec3& d) {
  return PhysicalSky(p).radiance(d, SkyPart::Gradient);
}

void expect_same(const Rgb& a, const Rgb& b, float relative = 1e-5f) {
  const float tolerance = relative * std::max(max_component(a), 1e-12f);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "channel " << i;
}

/// Cosine-weighted mean of lookups over the part of the hemisphere around `n` selected by `counts`.
template <typename Counts>
Rgb cosine_mean(const PhysicalSky& sky, const Frame& frame, Counts counts) {
  constexpr int kRings = 60, kSectors = 120;
  double sum[3] = {0, 0, 0};
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const float phi = kTwoPi * (static_cast<float>(j) + 0.5f) / kSectors, r = std::sqrt(sin2);
      const Vec3 local(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2));
      const Vec3 w = frame.to_world(local);
      if (!counts(w)) continue;
      const Rgb c = sky.radiance(w, SkyPart::Gradient);
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
  }
  const double n = kRings * kSectors;
  return Rgb(static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n),
             static_cast<float>(sum[2] / n));
}

constexpr auto kAll = [](const Vec3&) { return true; };

// acceptance: S1
TEST(PhysicalSky, MeanOfTheHemisphereIsLuxForUnitConversion) {
  const float table[][3] = {{0, 10, 19035}, {0, 45, 25165}, {1, 45, 28913}, {8, 45, 67241}};
  for (const auto& [haze, elevation, lux] : table) {
    const Rgb mean = cosine_mean(PhysicalSky(in_lux(elevation, haze)), Frame(), kAll);
    EXPECT_NEAR(luminance(mean), lux, 1e-3f * lux);
  }
}

// acceptance: S1
TEST(PhysicalSky, Conversion0318GivesLuminance) {
  SkyParameters p = in_lux(45);
  p.rgb_unit_conversion = Rgb(0.318f);
  // Table: 4012.13 cd/m2 opposite the sun at 45 degrees; 0.318 is 1/pi less 0.1 %.
  const float value = luminance(gradient(p, sky_direction(45, 180)));
  EXPECT_NEAR(value, 4012.13f * 0.318f * kPi, 1e-3f * value);
}

// acceptance: S1
TEST(PhysicalSky, ConversionOfZeroMaps80000LuxToOne) {
  SkyParameters zero = in_lux(45), one = in_lux(45);
  zero.rgb_unit_conversion = Rgb(0.0f);
  const Vec3 d = sky_direction(50, 70);
  expect_same(gradient(zero, d) * 80000, gradient(one, d));
  const SkyParameters defaults;
  SkyParameters lux = defaults;
  lux.rgb_unit_conversion = Rgb(1);
  expect_same(gradient(defaults, d) * 10000, gradient(lux, d));
}

// acceptance: S4
TEST(PhysicalSky, HazeBrightensAndWhitensTheSky) {
  float illuminance = 0, blueness = 1e9f;
  for (float haze = 0; haze <= 15; haze += 1.5f) {
    const SkyParameters p = in_lux(45, haze);
    const Rgb mean = cosine_mean(PhysicalSky(p), Frame(), kAll);
    EXPECT_GT(luminance(mean), illuminance) << haze;
    const Rgb zenith = gradient(p, Vec3(0, 0, 1));
    EXPECT_LT(zenith.z / zenith.x, blueness) << haze;
    illuminance = luminance(mean);
    blueness = zenith.z / zenith.x;
  }
}

// acceptance: S5
TEST(PhysicalSky, NeutralTintChangesNothing) {
  const SkyParameters p = in_lux(45, 4);
  const PreethamSky model(p.sun_direction, 6);
  expect_same(gradient(p, sky_direction(30, 80)), model.radiance(sky_direction(30, 80)) * kPi);
}

// acceptance: S5
TEST(PhysicalSky, SaturationZeroIsGreyOfTheSameLuminance) {
  SkyParameters p = in_lux(45, 2);
  const Vec3 d = sky_direction(60, 100);
  const float y = luminance(gradient(p, d));
  p.saturation = 0;
  expect_same(gradient(p, d), Rgb(y));
  p.saturation = -0.5f;
  expect_same(gradient(p, d), Rgb(y));
}

// acceptance: S5
TEST(PhysicalSky, SaturationGrowsThroughOneToTwo) {
  SkyParameters p = in_lux(45, 2);
  float spread = -1;
  for (float s : {0.0f, 0.3f, 0.7f, 1.0f, 1.5f, 2.0f}) {
    p.saturation = s;
    const Rgb c = gradient(p, Vec3(0, 0, 1));
    EXPECT_GT(c.z - c.x, spread) << s;
    spread = c.z - c.x;
  }
}

// acceptance: S5
TEST(PhysicalSky, HazeDeepensDesaturation) {
  // At haze 15 the cube of the saturation applies: 0.5 acts as 0.125.
  SkyParameters p = in_lux(45, 15);
  const Vec3 d = sky_direction(60, 100);
  const Rgb full = gradient(p, d);
  p.saturation = 0.5f;
  const Rgb grey(luminance(full));
  expect_same(gradient(p, d), grey + (full - grey) * 0.125f);
}

// acceptance: S5
TEST(PhysicalSky, RedShiftScalesRedAgainstBlue) {
  SkyParameters p = in_lux(45);
  const Vec3 d = sky_direction(60, 100);
  const Rgb neutral = gradient(p, d);
  for (float shift : {0.3f, -0.3f}) {
    p.redblueshift = shift;
    expect_same(gradient(p, d), neutral * Rgb(1 + shift, 1, 1 - shift));
  }
}

// acceptance: S6
TEST(PhysicalSky, HorizonHeightMovesTheHorizon) {
  for (float height : {-9.0f, -3.0f, -0.3f, 0.0f, 0.5f, 4.0f, 9.0f}) {
    SkyParameters p = in_lux(80);
    p.horizon_height = height;
    p.horizon_blur = 0;
    const PhysicalSky sky(p);
    const auto at = [](float z) { return Vec3(std::sqrt(1 - z * z), 0, z); };
    const float z = height / 10;
    EXPECT_EQ(sky.radiance(at(z - 1e-3f)), sky.ground_radiance()) << height;
    EXPECT_NE(sky.radiance(at(z + 1e-3f)), sky.ground_radiance()) << height;
  }
}

// acceptance: S6
TEST(PhysicalSky, ExtremeHorizonsAreAllSkyOrAllGround) {
  SkyParameters p = in_lux(45);
  p.horizon_blur = 0;
  p.horizon_height = 10;
  const PhysicalSky buried(p);
  p.horizon_height = -10;
  const PhysicalSky aloft(p);
  for (float elevation = -85; elevation <= 85; elevation += 10) {
    const Vec3 d = sky_direction(elevation, 200);
    EXPECT_EQ(buried.radiance(d), buried.ground_radiance());
    EXPECT_NE(aloft.radiance(d), aloft.ground_radiance());
  }
}

// acceptance: S6
TEST(PhysicalSky, BlurFadesIntoTheGroundWithoutAStep) {
  for (float blur : {0.1f, 1.0f, 10.0f}) {
    SkyParameters p = in_lux(45);
    p.horizon_blur = blur;
    const PhysicalSky sky(p);
    const auto at = [](float z) { return Vec3(0, std::sqrt(1 - z * z), z); };
    const Rgb horizon = sky.radiance(at(0), SkyPart::Gradient);
    expect_same(horizon, sky.radiance(at(1e-6f), SkyPart::Gradient), 1e-3f);
    // The middle of the smooth step is one half; at its full width only the ground is visible.
    const float middle = blur / 20;
    const Rgb mixed = sky.radiance(at(-middle), SkyPart::Gradient);
    expect_same(mixed, (horizon + sky.ground_radiance()) * 0.5f, 2e-3f);
    EXPECT_EQ(sky.radiance(at(-blur / 10)), sky.ground_radiance());
  }
}

// acceptance: S7
TEST(PhysicalSky, GroundSkyIlluminanceMatchesTable) {
  const float table[][3] = {
      {10, 14868, 6242}, {30, 20977, 40467}, {45, 22769, 65317}, {60, 22293, 84847}};
  for (const auto& [elevation, sky_lux, sun_lux] : table) {
    const PreethamSky model(sky_direction(elevation, 0), 2);
    EXPECT_NEAR(luminance(horizontal_illuminance_25(model)), sky_lux, 1e-3f * sky_lux);
    // A Lambert ground in the pi convention: albedo times illuminance, for any haze.
    for (float haze : {0.0f, 6.0f}) {
      const float expected = 0.2f * (sky_lux + sun_lux);
      const float ground = luminance(PhysicalSky(in_lux(elevation, haze)).ground_radiance());
      EXPECT_NEAR(ground, expected, 1e-3f * expected) << elevation;
    }
  }
}

// acceptance: S7
TEST(PhysicalSky, ExactGroundIsLitByTheWholeSky) {
  SkyParameters p = in_lux(45);
  p.as_in_manual = true;
  const float expected = 0.2f * (25165 + 65317);
  EXPECT_NEAR(luminance(PhysicalSky(p).ground_radiance()), expected, 1e-3f * expected);
}

// acceptance: S7
TEST(PhysicalSky, GroundLightsAWallWithHalfItsRadiance) {
  SkyParameters p = in_lux(45);
  p.horizon_blur = 0;
  const PhysicalSky sky(p);
  const Frame wall(Vec3(0, 1, 0));
  const Rgb below = cosine_mean(sky, wall, [](const Vec3& w) { return w.z < 0; });
  expect_same(below, sky.ground_radiance() * 0.5f, 0.01f);
}

// acceptance: S7
TEST(PhysicalSky, BlackGroundBouncesNothing) {
  SkyParameters p = in_lux(45);
  p.ground_color = Rgb(0.0f);
  EXPECT_TRUE(is_black(PhysicalSky(p).radiance(sky_direction(-60, 10))));
}

TEST(PhysicalSky, GroundIsColouredByItsAlbedo) {
  SkyParameters p = in_lux(45);
  p.ground_color = Rgb(1);
  const Rgb white = PhysicalSky(p).ground_radiance();
  p.ground_color = Rgb(0.8f, 0.1f, 0);
  expect_same(PhysicalSky(p).ground_radiance(), white * Rgb(0.8f, 0.1f, 0));
}

// acceptance: S8
TEST(PhysicalSky, TwilightFadesByTheFourthPower) {
  const float table[][2] = {{-2, .619181f}, {-5, .265703f}, {-10, .036825f}, {-15, .000696f}};
  for (const auto& [elevation, factor] : table) {
    EXPECT_NEAR(night_factor(std::sin(elevation * kDeg)), factor, 2e-6f);
    // A sun below the horizon counts as on the horizon, with reduced brightness. At the zenith both
    // are equal.
    const Rgb dusk = gradient(in_lux(0), Vec3(0, 0, 1));
    expect_same(gradient(in_lux(elevation), Vec3(0, 0, 1)), dusk * factor, 1e-3f);
  }
  EXPECT_EQ(night_factor(0.5f), 1);
  EXPECT_EQ(night_factor(std::sin(-18.01f * kDeg)), 0);
}

// acceptance: S8
TEST(PhysicalSky, NightColourIsAFloorPerChannel) {
  SkyParameters p = in_lux(45);
  const Vec3 d = sky_direction(40, 120);
  const Rgb day = gradient(p, d);
  p.night_color = Rgb(0.5f * day.x, 2 * day.y, 0.5f * day.z);
  expect_same(gradient(p, d), Rgb(day.x, 2 * day.y, day.z));
  // At night it is the only light, above the horizon only, and is not scaled by units.
  p.sun_direction = sky_direction(-40, 0);
  p.rgb_unit_conversion = Rgb(0.0001f);
  expect_same(gradient(p, d), p.night_color);
  EXPECT_TRUE(is_black(gradient(p, sky_direction(-40, 120))));
}

// acceptance: S15
TEST(PhysicalSky, YIsUpExchangesYAndZ) {
  SkyParameters z_up = in_lux(35, 3);
  z_up.sun_direction = sky_direction(35, 25);
  z_up.horizon_height = 0.2f;
  SkyParameters y_up = z_up;
  y_up.y_is_up = true;
  std::swap(y_up.sun_direction.y, y_up.sun_direction.z);
  for (float elevation = -40; elevation < 90; elevation += 13) {
    const Vec3 d = sky_direction(elevation, 60);
    EXPECT_EQ(PhysicalSky(z_up).radiance(d), PhysicalSky(y_up).radiance(Vec3(d.x, d.z, d.y)));
  }
}

// acceptance: S15
TEST(PhysicalSky, OnAndMultiplierScaleIt) {
  SkyParameters p = in_lux(45);
  for (const Vec3& d : {sky_direction(30, 10), sky_direction(-30, 10), p.sun_direction}) {
    p.multiplier = 1;
    const Rgb one = PhysicalSky(p).radiance(d);
    p.multiplier = 2.5f;
    expect_same(PhysicalSky(p).radiance(d), one * 2.5f);
    p.on = false;
    EXPECT_TRUE(is_black(PhysicalSky(p).radiance(d)));
    p.on = true;
    for (float off : {0.0f, -1.0f}) {
      p.multiplier = off;
      EXPECT_TRUE(is_black(PhysicalSky(p).radiance(d)));
    }
  }
}

TEST(PhysicalSky, LengthOfTheSunDirectionDoesNotMatter) {
  SkyParameters p = in_lux(45), longer = p;
  longer.sun_direction *= 37;
  expect_same(gradient(longer, sky_direction(30, 10)), gradient(p, sky_direction(30, 10)));
}

TEST(PhysicalSky, HorizonRadianceIsTheLimitFromAbove) {
  SkyParameters p = in_lux(30, 3);
  p.horizon_height = 0.4f;
  const PhysicalSky sky(p);
  const Vec3 just_above(std::sqrt(1 - sqr(0.0401f)), 0, 0.0401f);
  expect_same(sky.horizon_radiance(Vec3(1, 0, 0)), sky.radiance(just_above, SkyPart::Gradient),
              1e-3f);
}

TEST(PhysicalSky, IsFiniteAndNeverNegative) {
  std::mt19937 random(20240611);
  const auto uniform = [&](float lo, float hi) {
    return std::uniform_real_distribution<float>(lo, hi)(random);
  };
  const auto any_direction = [&] {
    const float z = uniform(-1, 1), phi = uniform(0, kTwoPi), r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(phi), r * std::sin(phi), z);
  };
  std::vector<Vec3> edges;
  for (float s : {-1.0f, 1.0f})
    for (int i = 0; i < 3; ++i) (edges.emplace_back(0, 0, 0), edges.back()[i] = s);
  for (int trial = 0; trial < 3000; ++trial) {
    SkyParameters p;
    p.haze = uniform(-1, 25);
    p.redblueshift = uniform(-1.5f, 1.5f);
    p.saturation = uniform(-0.5f, 3);
    p.horizon_height = trial % 4 ? uniform(-1, 1) : std::round(uniform(-11, 11));
    p.horizon_blur = trial % 3 ? uniform(0, 1) : std::round(uniform(-1, 10));
    p.ground_color = Rgb(uniform(0, 1), uniform(0, 1), uniform(0, 1));
    p.night_color = Rgb(uniform(-0.1f, 0.1f));
    p.sun_disk_scale = uniform(-1, 100);
    p.sun_disk_intensity = uniform(-1, 10);
    p.sun_glow_intensity = uniform(-1, 10);
    p.physically_scaled_sun = trial % 2;
    p.y_is_up = trial % 5 == 0;
    p.sun_direction = trial % 7 ? any_direction() : edges[trial % edges.size()];
    if (trial == 0) p.sun_direction = Vec3(0, 0, 0);
    const PhysicalSky sky(p);
    std::vector<Vec3> looks = edges;
    looks.insert(looks.end(), {p.sun_direction, -p.sun_direction});
    for (int i = 0; i < 20; ++i) looks.push_back(any_direction());
    for (const Vec3& d : looks) {
      for (SkyPart part : {SkyPart::Gradient, SkyPart::GradientAndGlow, SkyPart::Everything}) {
        const Rgb c = sky.radiance(d, part);
        ASSERT_TRUE(is_finite(c)) << "trial " << trial;
        ASSERT_TRUE(c.x >= 0 && c.y >= 0 && c.z >= 0) << "trial " << trial;
      }
      ASSERT_TRUE(is_finite(sky.horizon_radiance(d))) << "trial " << trial;
    }
  }
}

}  // namespace physical_sky_test
}  // namespace oriel::sky
