// SPDX-License-Identifier: Apache-2.0
// Irradiance of uniform and physical skies, and of the sun, on a white card.
#include "support/probe.h"

namespace oriel::testing {
namespace sky_test {

/// Direction from elevation and azimuth, degrees; y takes z's place when y is up.
Vec3 toward(float elevation, float azimuth, bool y_up = false) {
  const float e = elevation * kPi / 180, a = azimuth * kPi / 180;
  const Vec3 d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  return y_up ? Vec3(d.x, d.z, -d.y) : d;
}

std::string sky(const std::string& more) {
  return "\"mia_physicalsky\" ( \"ground_color\" 0 0 0, \"horizon_blur\" 0" +
         (more.empty() ? "" : ", " + more) + " )";
}

std::string conversion(float c) { return fmt::format("\"rgb_unit_conversion\" {0} {0} {0}", c); }

std::string sun_direction(float elevation) {
  return fmt::format("\"sun_direction\" {}", text_of(toward(elevation, 20)));
}

// acceptance: S1
TEST(Sky, UniformSkyOverACardFollowsThePiConvention) {
  // physics: rho .5, L = 1000 cd/m2. An environment shader returns pi L conv; a pixel is E rho
  // conv.
  for (const auto& [conv, pixel] : {std::pair(1.0f, 1570.80f), {.318f, 499.513f}}) {
    SceneText scene;
    scene.uniform_sky(kPi * 1000 * conv).lambert("card", .5f).square("card", Vec3(0), 1, kUp);
    expect_exact(fmt::format("card .5 under 1000 cd/m2, conversion {}", conv),
                 Probe(scene).onto(Vec3(0), kUp, 30), pixel);
  }
}

// The night colour is a floor of the whole sphere: with nothing above it the sky is uniform.
// acceptance: S1
TEST(Sky, ConversionsScaleAsDocumented) {
  const auto card = [](const std::string& units) {
    SceneText scene;
    scene.environment(sky(sun_direction(45) + ", \"haze\" 1" + (units.empty() ? "" : ", " + units)))
        .lambert("card", 1)
        .square("card", Vec3(0), 1, kUp);
    return Probe(scene).onto(Vec3(0), kUp, 0, 65536);
  };
  // Horizontal illuminance of the sky at T 3, 45 degrees: 28913 lx, by luminance.
  const Measured lux = card(conversion(1));
  const float y = 0.2126f * lux.mean.x + 0.7152f * lux.mean.y + 0.0722f * lux.mean.z;
  EXPECT_NEAR(y, 28913, 4 * lux.error.y + 0.002f * 28913);
  figure("white card, sky T 3 el 45, lux", 28913, y, lux.error.y);
  for (const auto& [units, factor] : {std::pair(conversion(.318f), .318f),
                                      {conversion(0), 1 / 80000.0f},
                                      {std::string(), .0001f}})
    expect_same("card in units " + units, card(units), [&] {
      Measured m = lux;
      m.mean *= factor;
      m.error *= factor;
      return m;
    }());
}

// acceptance: S2, S3
TEST(Sky, SkyAndSunLightACardAsTabulated) {
  struct Row {
    float haze, elevation, sky_horizontal;
    Rgb sun_normal;
  };
  const Row rows[] = {
      {0, 10, 19035, {43315, 35358, 20066}},   {0, 45, 25165, {97918, 92459, 75174}},
      {0, 90, 27361, {106147, 101684, 85668}}, {1, 45, 28913, {86524, 80257, 63192}},
      {3, 30, 30946, {51763, 44414, 29983}},   {3, 60, 48357, {76054, 69368, 53308}},
      {8, 45, 67241, {36396, 29800, 18744}},   {15, 45, 94227, {15310, 11065, 5559}}};
  for (const Row& row : rows) {
    const std::string haze = fmt::format("\"haze\" {}, ", row.haze) + conversion(1);
    SceneText sky_scene;
    sky_scene.environment(sky(sun_direction(row.elevation) + ", " + haze))
        .lambert("card", 1)
        .square("card", Vec3(0), 1, kUp);
    const Measured m = Probe(sky_scene).onto(Vec3(0), kUp, 0, 65536);
    const float y = 0.2126f * m.mean.x + 0.7152f * m.mean.y + 0.0722f * m.mean.z;
    EXPECT_NEAR(y / row.sky_horizontal, 1, 0.002f + 4 * m.error.y / m.mean.y)
        << row.haze << ' ' << row.elevation;
    figure(fmt::format("sky on card, haze {} el {}, lx", row.haze, row.elevation),
           row.sky_horizontal, y, m.error.y);

    SceneText sun_scene;
    const Vec3 to_sun = toward(row.elevation, 20);
    sun_scene.lambert("card", 1)
        .square("card", Vec3(0), 1, kUp)
        .square("card", Vec3(5, 0, 0), 1, to_sun)
        .light("sun",
               fmt::format("\"mia_physicalsun\" ( {} ) direction {}", haze, text_of(-to_sun)));
    const Probe probe(sun_scene);
    const Measured facing = probe.onto(Vec3(5, 0, 0), to_sun, 0, 8192);
    const Measured flat = probe.onto(Vec3(0), kUp, 0, 8192);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(facing.mean[k] / row.sun_normal[k], 1, 0.001f)
          << row.haze << ' ' << row.elevation;
      EXPECT_NEAR(flat.mean[k] / (row.sun_normal[k] * to_sun.z), 1, 0.001f);
    }
    figure(fmt::format("sun facing card, haze {} el {}, red lx", row.haze, row.elevation),
           row.sun_normal.x, facing.mean.x, facing.error.x);
  }
}

// acceptance: S3
TEST(Sky, CameraSeesTheGradientAsTabulated) {
  struct Sample {
    float haze, sun_elevation, zenith_angle, azimuth, luminance;
  };
  for (const Sample& s : {Sample{0, 45, 45, 180, 4012.13f}, Sample{0, 45, 80, 0, 25919.56f},
                          Sample{0, 45, 80, 90, 12639.49f}, Sample{0, 45, 80, 180, 11859.77f},
                          Sample{1, 45, 80, 0, 17239.70f}, Sample{1, 45, 80, 180, 7653.94f},
                          Sample{3, 30, 80, 0, 20997.14f}, Sample{3, 30, 80, 180, 6116.77f}}) {
    SceneText scene;
    scene.environment(
        sky(fmt::format("\"sun_direction\" {}, \"haze\" {}, \"sun_disk_intensity\" 0, "
                        "\"sun_glow_intensity\" 0, ",
                        text_of(toward(s.sun_elevation, 0)), s.haze) +
            conversion(.31830989f)));
    const Measured m = Probe(scene).ray(Vec3(0), toward(90 - s.zenith_angle, s.azimuth), 64);
    const float y = 0.2126f * m.mean.x + 0.7152f * m.mean.y + 0.0722f * m.mean.z;
    EXPECT_NEAR(y / s.luminance, 1, 0.001f) << s.haze << ' ' << s.zenith_angle << ' ' << s.azimuth;
    figure(fmt::format("sky seen, haze {}, zenith angle {}, azimuth {}, cd/m2", s.haze,
                       s.zenith_angle, s.azimuth),
           s.luminance, y, 0);
  }
}

// acceptance: S15
TEST(Sky, YIsUpTurnsTheSkyAndSun) {
  const auto card = [](bool y_up) {
    const std::string common = conversion(.0001f) + (y_up ? ", \"y_is_up\" on" : "");
    const Vec3 to_sun = toward(30, 40, y_up);
    SceneText scene;
    scene.environment(sky(fmt::format("\"sun_direction\" {}, ", text_of(to_sun)) + common))
        .lambert("card", 1)
        .square("card", Vec3(0), 1, y_up ? Vec3(0, 1, 0) : kUp)
        .light("sun",
               fmt::format("\"mia_physicalsun\" ( {} ) direction {}", common, text_of(-to_sun)));
    return Probe(scene).onto(Vec3(0), y_up ? Vec3(0, 1, 0) : kUp, 0, 65536);
  };
  expect_same("y up against z up", card(true), card(false));
}

// acceptance: S15
TEST(Sky, OnAndMultiplierActOnSkyAndSun) {
  const auto card = [](const std::string& sky_more, const std::string& sun_more) {
    SceneText scene;
    scene.environment(sky(sun_direction(30) + sky_more))
        .lambert("card", 1)
        .square("card", Vec3(0), 1, kUp)
        .light("sun", fmt::format("\"mia_physicalsun\" ( \"haze\" 0{} ) direction {}", sun_more,
                                  text_of(-toward(30, 20))));
    return Probe(scene).onto(Vec3(0), kUp, 0, 32768);
  };
  const Measured sky_only = card("", ", \"on\" off"), sun_only = card(", \"on\" off", "");
  const Measured both = card("", "");
  EXPECT_NEAR(both.mean.y, sky_only.mean.y + sun_only.mean.y,
              4 * (both.error.y + sky_only.error.y + sun_only.error.y));
  EXPECT_NEAR(sun_only.mean.y, 8.0868f * .5f, 0.002f * 4.04f);
  const Measured twice = card(", \"multiplier\" 2", ", \"multiplier\" 2");
  EXPECT_NEAR(twice.mean.y, 2 * both.mean.y, 4 * (twice.error.y + 2 * both.error.y));
  EXPECT_EQ(card(", \"on\" off", ", \"on\" off").mean, Rgb(0));
}

// acceptance: S13
TEST(Sky, SunShadowsAreAsWideAsTheSun) {
  // An edge 10 m above the ground under a zenith sun: the lit share at x is that of a disc of
  // half-angle .00465 rad cut at x / h, so the penumbra is 93.0 mm wide.
  SceneText scene;
  scene.lambert("card", 1)
      .square("card", Vec3(0), 2, kUp)
      .polygon("card", {Vec3(0, -5, 10), Vec3(5, -5, 10), Vec3(5, 5, 10), Vec3(0, 5, 10)})
      .light("sun", "\"mia_physicalsun\" ( \"haze\" 0 ) direction 0 0 -1");
  Probe probe(scene);
  probe.direct_only();
  const float open = probe.onto(Vec3(-1, 0, 0), kUp).mean.y;
  EXPECT_EQ(probe.onto(Vec3(.048f, 0, 0), kUp).mean.y, 0);
  EXPECT_NEAR(probe.onto(Vec3(-.048f, 0, 0), kUp).mean.y, open, 1e-4f * open);
  for (const float x : {-.03f, -.01f, 0.0f, .02f, .04f}) {
    const double t = -x / (10 * std::tan(.00465));
    const double share = .5 + (std::asin(t) + t * std::sqrt(1 - t * t)) / kPi;
    expect_exact(fmt::format("penumbra at {} m", x), probe.onto(Vec3(x, 0, 0), kUp, 0, 65536),
                 Rgb(probe.onto(Vec3(-1, 0, 0), kUp).mean) * static_cast<float>(share), .02f);
  }
}

}  // namespace sky_test
}  // namespace oriel::testing
