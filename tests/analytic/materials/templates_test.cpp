// SPDX-License-Identifier: Apache-2.0
// Glass and liquid templates of templates.mi, measured in scenes that include the file.
#include <fstream>
#include <iterator>
#include <numbers>

#include "support/probe.h"

namespace oriel::testing {
namespace templates_test {

constexpr double kRadians = std::numbers::pi / 180;

/// Unpolarised Fresnel reflectance of an interface of relative index n, in double.
double fresnel(double sine, double n) {
  const double c = std::sqrt(1 - sine * sine), s = sine / n;
  if (s >= 1) return 1;
  const double t = std::sqrt(1 - s * s);
  const double rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
  return (rs * rs + rp * rp) / 2;
}

/// The file's text, its textures with their whole path.
SceneText with_templates() {
  const std::string folder = ORIEL_DATA_FOLDER;
  std::ifstream file(folder + "/templates.mi");
  EXPECT_TRUE(file) << folder;
  std::string text(std::istreambuf_iterator<char>(file), {});
  constexpr std::string_view kTextures = "\"textures/";
  for (std::size_t at = 0; (at = text.find(kTextures, at)) != std::string::npos;
       at += folder.size() + kTextures.size())
    text.insert(at + 1, folder + "/");
  SceneText scene;
  scene.statement(text);
  return scene;
}

/// Along a ray that meets the origin at `degrees` from the axis, coming from below.
Measured rising(const SceneText& scene, double degrees, int samples = 1 << 16) {
  const float a = static_cast<float>(degrees * kRadians);
  const Vec3 d(std::sin(a), 0, std::cos(a));
  return Probe(scene).ray(d * -.5f, d, samples);
}

// The template has .08 .3 .75 at 0.1; two faces of index 1.5 transmit .96 each.
// acceptance: T13
TEST(Templates, ColouredGlassHasItsColourAtTheDistanceAndItsPowersElsewhere) {
  for (const float thick : {.05f, .1f, .2f}) {
    const SceneText scene = with_templates().half_sky(1, kUp).box(
        "template_coloured_glass", Vec3(-5, -5, 0), Vec3(5, 5, thick));
    const float depth = thick / .1f;
    expect_exact(fmt::format("coloured glass, {} of 0.1 thick", thick), rising(scene, 0),
                 Rgb(std::pow(.08f, depth), std::pow(.3f, depth), std::pow(.75f, depth)) * .9216f);
  }
}

// acceptance: T13
TEST(Templates, WaterRefractsAndDarkensWithDistance) {
  for (const double degrees : {30.0, 60.0}) {
    const double outside = std::sin(degrees * kRadians), inner = std::asin(outside / 1.33);
    SceneText scene = with_templates();
    scene.statement("shader \"place\" \"test_place\" ()")
        .material("target",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .box("template_water", Vec3(-5, -5, 0), Vec3(5, 5, .5f))
        .square("target", Vec3(0, 0, 1), 50, -kUp);
    const double x = .5 * std::tan(inner) + .5 * std::tan(degrees * kRadians);
    const double way = .5 / std::cos(inner), pass = std::pow(1 - fresnel(outside, 1.33), 2);
    expect_exact(fmt::format("place seen through water at {} deg", degrees), rising(scene, degrees),
                 Rgb(static_cast<float>(x * pass * std::pow(.72, way)), 0,
                     static_cast<float>(pass * std::pow(.95, way))));
  }
}

// acceptance: T13
TEST(Templates, OceanReflectsTheSkyByFresnelAndShowsNothingElse) {
  // Index 1.33: tables give 2.0059 % straight down and 5.9126 % at 60 degrees.
  const std::pair<double, float> table[] = {{0, .020059f}, {60, .059126f}};
  for (const auto& [degrees, reflected] : table) {
    const SceneText sky =
        with_templates().half_sky(1, -kUp).square("template_ocean", Vec3(0), 5, -kUp);
    expect_exact(fmt::format("ocean at {} deg", degrees), rising(sky, degrees, 1 << 17), reflected,
                 .01f);
    // A bright ground under it, a sun on it: neither is seen.
    const SceneText rest =
        with_templates()
            .half_sky(1, kUp)
            .emitter("ground", 100)
            .square("template_ocean", Vec3(0), 50, -kUp)
            .square("ground", Vec3(0, 0, 1), 50, -kUp)
            .light("sun", "\"mib_light_infinite\" ( \"color\" 9 9 9 ) direction .6 0 .8");
    EXPECT_EQ(rising(rest, degrees, 4096).mean, Rgb(0)) << degrees;
  }
}

// Waves move the normal where there are texture coordinates: the reflectance varies about
// Fresnel's. acceptance: T13
TEST(Templates, OceanWithTextureCoordinatesHasWaves) {
  SceneText scene = with_templates();
  scene.half_sky(1, -kUp).statement(
      "object \"sea\" visible on shadow on trace on group\n"
      "-5 -5 0  -5 5 0  5 5 0  5 -5 0  0 0 0  0 1 0  1 1 0  1 0 0\n"
      "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end object\n"
      "instance \"sea_i\" \"sea\" material \"template_ocean\" end instance\n");
  std::string text = scene.str();
  text.insert(text.find(" end instgroup", text.find("instgroup \"world\"")), " \"sea_i\"");
  const Probe probe(text);
  float least = 1, most = 0;
  for (int i = 0; i < 12; ++i) {
    const Vec3 d(std::sin(60 * kPi / 180), 0, .5f);
    const float r = probe.ray(Vec3(.31f * i - 1.7f, .43f * i - 2, 0) - d, d, 8192).mean.x;
    least = std::min(least, r);
    most = std::max(most, r);
  }
  EXPECT_LT(least, .0591f);
  EXPECT_GT(most, .0591f);
  EXPECT_GT(most / least, 1.2f);
}

// acceptance: T13
TEST(Templates, BeverageRefractsFromGlassIntoLiquidWithoutAnAirGap) {
  // In the size of a real glass, or the shift of ray origins shows: air, 4 mm of glass, 96 mm of
  // liquid, air, and a target that tells where it is seen.
  constexpr double kGlass = .004, kLiquid = .096, kAir = .1, kRatio = 1.33 / 1.5;
  for (const double degrees : {0.0, 35.0, 60.0}) {
    SceneText scene = with_templates();
    scene.statement("shader \"place\" \"test_place\" ()")
        .material("target",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
        .square("template_beverage_air_glass", Vec3(0), .5f, -kUp)
        .square("template_beverage_glass_liquid", Vec3(0, 0, kGlass), .5f, -kUp)
        .square("template_beverage_air_liquid", Vec3(0, 0, kGlass + kLiquid), .5f, kUp)
        .square("target", Vec3(0, 0, kGlass + kLiquid + kAir), 1, -kUp);
    const double air = std::sin(degrees * kRadians), glass = air / 1.5, liquid = air / 1.33;
    const double x = kGlass * std::tan(std::asin(glass)) + kLiquid * std::tan(std::asin(liquid)) +
                     kAir * std::tan(degrees * kRadians);
    const double pass =
        (1 - fresnel(air, 1.5)) * (1 - fresnel(glass, kRatio)) * (1 - fresnel(liquid, 1 / 1.33));
    // .85 .42 .06 at 0.05.
    const double depth = kLiquid / std::sqrt(1 - liquid * liquid) / .05;
    expect_exact(fmt::format("target through glass and liquid at {} deg", degrees),
                 rising(scene, degrees, 1 << 18),
                 Rgb(static_cast<float>(x * pass * std::pow(.85, depth)), 0,
                     static_cast<float>((kGlass + kLiquid + kAir) * pass * std::pow(.06, depth))));
  }
}

// acceptance: T13
TEST(Templates, GlassIsTotallyReflectingTowardLiquidOnlyBeyond62Degrees) {
  // asin(1.33/1.5) = 62.46 degrees; toward air it would be 41.81.
  for (const double degrees : {50.0, 60.0, 62.4, 62.5, 70.0}) {
    const SceneText scene = with_templates().half_sky(1, -kUp).square(
        "template_beverage_glass_liquid", Vec3(0), 5, -kUp);
    const double r = fresnel(std::sin(degrees * kRadians), 1.33 / 1.5);
    EXPECT_EQ(r == 1, degrees > 62.46);
    expect_exact(fmt::format("glass toward liquid at {} deg", degrees),
                 rising(scene, degrees, 1 << 17), static_cast<float>(r), .01f);
  }
}

}  // namespace templates_test
}  // namespace oriel::testing
