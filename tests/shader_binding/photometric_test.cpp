// SPDX-License-Identifier: Apache-2.0
// Photometric lights in scenes: illuminance, orientation of profiles, reports of invalid profiles.
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "lights/photon_source.h"
#include "lights/sample_light.h"
#include "probe.h"
#include "transport/path/direct.h"

namespace oriel {
namespace photometric_test {

std::string written(const std::string& name, const std::string& text) {
  const std::string path = ::testing::TempDir() + "/oriel-" + name;
  std::ofstream(path) << text;
  return path;
}

/// 1000 cd in all directions; 12566.37 lm.
std::string even_ies() {
  return written("even.ies", "IESNA91\nTILT=NONE\n1 -1 10 2 1 1 2 0 0 0 1 1 40\n0 180\n0\n100 100");
}
/// 500 cd around the horizon in the half plane of 0 degrees, fading to none within 20 to each side.
std::string one_plane_ies() {
  return written("plane.ies",
                 "IESNA91\nTILT=NONE\n1 -1 1 4 4 1 2 0 0 0 1 1 40\n0 60 120 180\n0 20 340 360\n"
                 "0 500 500 0\n0 0 0 0\n0 0 0 0\n0 500 500 0");
}
/// Cosines of 2000 cd down.
std::string lambert_ldt() {
  std::string text = "Maker\n1\n1\n1\n0\n19\n5\nR\nLamp\n7\nf\n2020\n";
  for (int i = 0; i < 9; ++i) text += "100\n";
  text += "100\n80\n1\n0\n1\n1\nLED\n2000\n3000\n80\n25\n";
  for (int i = 0; i < 10; ++i) text += "0.5\n";
  text += "0\n";
  for (int g = 0; g <= 90; g += 5) text += fmt::format("{}\n", g);
  for (int g = 0; g <= 90; g += 5)
    text += fmt::format("{:.4f}\n", 1000 * std::cos(g * 3.14159265 / 180));
  return written("lambert.ldt", text);
}

std::string profile(const std::string& path, const std::string& more = "format ies") {
  return fmt::format("lightprofile \"lp\" {} file \"{}\" end lightprofile\n", more, path);
}

/// A scene of one light.
struct OneLight {
  explicit OneLight(const std::string& light, const std::string& before = "",
                    const std::string& transform = "")
      : scene(testing::scene_text(
            fmt::format("material \"m\" \"mib_illum_lambert\" ( ) end material\n{}light \"l\" {} "
                        "end light instance \"li\" \"l\" {} end instance",
                        before, light, transform),
            "\"li\"")) {}
  const Light& light() const { return scene.world->lights.at(0); }
  /// Irradiance facing the light, of a light at the middle of its shape.
  Rgb at(const Vec3& place, Vec2 u = Vec2(.5f)) const {
    ShadingPoint point;
    point.position = place;
    point.world = scene.world.get();
    const auto sample = sample_light(light(), point, u);
    return sample ? sample->irradiance : Rgb(0);
  }
  testing::PreparedScene scene;
};

const std::string kMib = "\"mib_light_photometric\" ( \"color\" 1 1 1, \"profile\" \"lp\" ) ";
std::string mia(const std::string& parameters) {
  return fmt::format("\"mia_photometric_light\" ( {} ) ", parameters);
}
const std::string kDown = "origin 0 0 0 ";

// acceptance: H6
TEST(PhotometricLights, CandelaAndMetresMakeLux) {
  const OneLight measured(kMib + kDown, profile(even_ies()));
  EXPECT_TRUE(measured.scene.diagnostics.all().empty()) << measured.scene.messages();
  const OneLight manual(mia("\"manual_peak_intensity_cd\" 1000") + kDown);
  const OneLight lumen(mia("\"intensity_mode\" 1, \"manual_flux_lm\" 12566.37") + kDown);
  const OneLight scaled(
      mia("\"intensity_mode\" 2, \"distribution_mode\" 2, \"profile\" \"lp\"") + kDown,
      profile(even_ies()));
  for (const OneLight* l : {&measured, &manual, &lumen, &scaled}) {
    EXPECT_NEAR(l->at(Vec3(0, 0, -2)).x, 250, .02);
    // On a floor 2 m below, where light falls in at 30 degrees: I cos^3 / h^2.
    const Vec3 floor(2 * std::tan(kPi / 6), 0, -2);
    EXPECT_NEAR(l->at(floor).y * std::cos(kPi / 6), 162.38, .02);
  }
  // Centimetres, and pixels in other units.
  const OneLight centimetres(mia("\"manual_peak_intensity_cd\" 1000, \"units_to_meter_scale\" .01, "
                                 "\"cm2_factor\" .5, \"multiplier\" 3, \"color\" 1 .5 0") +
                             kDown);
  EXPECT_NEAR(centimetres.at(Vec3(0, 0, -200)).x, 375, .05);
  EXPECT_NEAR(centimetres.at(Vec3(0, 0, -200)).y, 187.5, .05);
  EXPECT_EQ(centimetres.at(Vec3(0, 0, -200)).z, 0);
  EXPECT_EQ(
      OneLight(mia("\"on\" off, \"manual_peak_intensity_cd\" 9") + kDown).at(Vec3(0, 0, -1)).x, 0);
}

TEST(PhotometricLights, EveryIntensityModeScalesEveryDistribution) {
  const std::string ldt = profile(lambert_ldt(), "format eulumdat");
  const std::string by_profile = "\"distribution_mode\" 2, \"profile\" \"lp\", ";
  const Vec3 below(0, 0, -1), aside(std::sin(kPi / 3), 0, -.5f);
  const OneLight as_is(mia(by_profile + "\"intensity_mode\" 2") + kDown, ldt);
  EXPECT_NEAR(as_is.at(below).x, 2000, .1);
  EXPECT_NEAR(as_is.at(aside).x, 1000, .1);
  EXPECT_EQ(as_is.at(Vec3(0, 0, 1)).x, 0);
  const OneLight peak(mia(by_profile + "\"manual_peak_intensity_cd\" 300") + kDown, ldt);
  EXPECT_NEAR(peak.at(below).x, 300, .02);
  EXPECT_NEAR(peak.at(aside).x, 150, .02);
  // A lambert distribution of 1000 lm has 1000 / pi cd.
  const OneLight flux(mia(by_profile + "\"intensity_mode\" 1, \"manual_flux_lm\" 1000") + kDown,
                      ldt);
  EXPECT_NEAR(flux.at(below).x, 1000 / kPi, .5);
  // The profile's 2000 pi lm spread evenly.
  const OneLight even(mia("\"intensity_mode\" 2, \"profile\" \"lp\"") + kDown, ldt);
  EXPECT_NEAR(even.at(below).x, 500, 1);
  // A spot of 60 degrees: 1000 lm over 2 pi (1 - cos 30) sr; with a bias of 2 over a third of
  // 2 pi (1 - cos^3 30).
  const std::string cone = "origin 0 0 0 direction 0 0 -1 spread .8660254";
  const std::string lumen =
      "\"distribution_mode\" 1, \"intensity_mode\" 1, \"manual_flux_lm\" 1000";
  const OneLight spot(mia(lumen) + cone),
      shaped(mia(lumen + ", \"spotlight_cosine_bias\" 2") + cone);
  EXPECT_NEAR(spot.at(below).x, 1000 / (2 * kPi * (1 - std::cos(kPi / 6))), .1);
  EXPECT_EQ(spot.at(aside).x, 0);
  const float top = 1000 / (2 * kPi / 3 * (1 - std::pow(std::cos(kPi / 6), 3.0f)));
  EXPECT_NEAR(shaped.at(below).x, top, .1);
  const float a = 20 * kPi / 180;
  EXPECT_NEAR(shaped.at(Vec3(std::sin(a), 0, -std::cos(a))).x, top * sqr(std::cos(a)), .1);
}

// acceptance: H6
TEST(PhotometricLights, AProfileTurnsWithItsLight) {
  // The bright half plane is on +x of the light's space, around its direction.
  const std::string lp = profile(one_plane_ies());
  const OneLight plain(kMib + kDown, lp);
  EXPECT_NEAR(plain.at(Vec3(1, 0, 0)).x, 500, .1);
  for (const Vec3& dark : {Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)})
    EXPECT_EQ(plain.at(dark).x, 0);
  // Walls of a room: only the one at +x is lit, halfway to its border at 10 degrees.
  EXPECT_NEAR(plain.at(normalize(Vec3(1, std::tan(kPi / 18), 0))).x, 250, .5);
  // The instance turns it by a quarter about z (a scene's matrices take the world to the light).
  const OneLight turned(kMib + kDown, lp, "transform 0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1");
  EXPECT_NEAR(turned.at(Vec3(0, 1, 0)).x, 500, .1);
  EXPECT_EQ(turned.at(Vec3(1, 0, 0)).x, 0);
  // A light that shines along -y with x across, as hosts with y up write it.
  const OneLight lying(kMib + "origin 0 0 0 direction 0 -1 0 spread -1", lp);
  EXPECT_NEAR(lying.at(Vec3(1, 0, 0)).x, 500, .1);
  EXPECT_EQ(lying.at(Vec3(0, 0, 1)).x, 0);
  // EULUMDAT: C0 lies across the luminaire, at -y.
  const OneLight even(kMib + kDown, profile(lambert_ldt(), ""));
  EXPECT_NEAR(even.at(Vec3(0, 0, -1)).x, 2000, .1);
}

TEST(PhotometricLights, FlagsAndInterpolationOfTheElementAct) {
  const std::string path =
      written("turn.ies",
              "IESNA91\nTILT=NONE\n1 -1 1 3 5 1 2 0 0 0 1 1 40\n0 90 180\n0 90 180 270 360\n"
              "0 0 0  0 800 0  0 0 0  0 0 0  0 0 0\n");
  const auto at = [&](const std::string& items, const Vec3& place) {
    return OneLight(kMib + kDown, profile(path, items)).at(place).x;
  };
  EXPECT_NEAR(at("format ies", Vec3(0, 1, 0)), 800, .1);
  EXPECT_NEAR(at("format ies flags 1", Vec3(0, -1, 0)), 800, .1);
  EXPECT_NEAR(at("flags 2", Vec3(0, 1, 0)), 800, .1);
  const Vec3 between(0, std::sin(kPi / 3), -std::cos(kPi / 3));
  EXPECT_NEAR(at("hermite 1", between), 800 * 60.0 / 90, .2);
  // The cubic from 0 with the slope of the parabola through all three to 800, level there.
  const float t = 60.0f / 90;
  const float exact = 800 * (3 * t * t - 2 * t * t * t + 2 * t * sqr(1 - t));
  EXPECT_NEAR(at("hermite 3 resolution 90 90", between), exact, .5);
  EXPECT_NEAR(at("hermite 3", between), exact, .5);
}

// acceptance: H6
TEST(PhotometricLights, AProfileInTheLightShapesItsEnergy) {
  const std::string lp = profile(lambert_ldt(), "format eulumdat");
  const std::string physical = "\"physical_light\" ( \"color\" 100 100 100 ) origin 0 0 0 ";
  const OneLight light(physical + "lightprofile \"lp\"", lp);
  // Lambert instead of even: four times as much straight down, as much in all.
  EXPECT_NEAR(light.at(Vec3(0, 0, -1)).x, 4 * OneLight(physical).at(Vec3(0, 0, -1)).x, .1);
  EXPECT_NEAR(PhotonSource(*light.scene.world, light.light()).estimate_flux(256).x, 100 * kPi, .1);
  const OneLight own(
      std::string("\"mib_light_photometric\" ( \"color\" 1 1 1 ) ") + kDown + "lightprofile \"lp\"",
      lp);
  EXPECT_NEAR(own.at(Vec3(0, 0, -1)).x, 2000, .1);
}

// acceptance: H6
TEST(PhotometricLights, ShapesSpreadAProfileOverTheirArea) {
  const std::string lp = profile(lambert_ldt(), "");
  for (const char* shape :
       {"rectangle .3 0 0 0 .2 0", "disc 0 0 -1 .2", "sphere .2", "cylinder .2 0 0 .05"}) {
    const OneLight light(kMib + "origin 0 0 0 direction 0 0 -1 spread -1 " + shape, lp);
    for (const Vec3& place : {Vec3(0, 0, -5), Vec3(0, 3, -4)}) {
      double mean = 0;
      constexpr int kDraws = 4000;
      for (int i = 0; i < kDraws; ++i) {
        sampling::Sampler s(i, 3, 0);
        mean += double{light.at(place, s.next_2d()).x} / kDraws;
      }
      const double exact = 2000 * -place.z / 5 / 25;
      EXPECT_NEAR(mean, exact, .03 * exact) << shape;
    }
  }
}

TEST(PhotometricLights, ABadProfileIsOneMessageWithFileLineAndAdvice) {
  const std::string path =
      written("bad.ies", "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 40\n0 180\n0\n100 -5\n");
  // The profile is referenced twice, by the shader and by the light.
  const OneLight light(
      "\"mib_light_photometric\" ( \"color\" 1 1 1, \"profile\" \"lp\" ) origin 0 0 0 "
      "lightprofile \"lp\"",
      profile(path));
  const auto& all = light.scene.diagnostics.all();
  ASSERT_EQ(all.size(), 1u) << light.scene.messages();
  EXPECT_EQ(all[0].code, "OR-RT-040");
  EXPECT_EQ(light.scene.diagnostics.file(all[0].where.file), path);
  EXPECT_EQ(all[0].where.line, 6u);
  EXPECT_NE(all[0].hint.find("correct the file"), std::string::npos);
  // It shines evenly.
  EXPECT_NEAR(light.at(Vec3(0, 0, 1)).x, 1, 1e-5);
  const OneLight absent(kMib + kDown, profile("/nowhere/lamp.ies"));
  EXPECT_TRUE(absent.scene.diagnostics.has("OR-RT-040"));
  const OneLight misspelt("\"mib_light_photometric\" ( \"profile\" \"lq\" ) origin 0 0 0",
                          profile(even_ies()));
  EXPECT_TRUE(misspelt.scene.diagnostics.has("OR-RT-042"));
  EXPECT_NE(misspelt.scene.messages().find("did you mean \"lp\""), std::string::npos);
}

}  // namespace photometric_test
}  // namespace oriel
