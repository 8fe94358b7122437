// SPDX-License-Identifier: Apache-2.0
// Form factors of light shapes on a white card, and transmission through a sheet.
#include "support/probe.h"

namespace oriel::testing {
namespace light_test {

/// A white Lambert card at the origin that faces up; in pixel units its radiance is E / pi.
SceneText card() {
  SceneText scene;
  scene.lambert("card", 1).square("card", Vec3(0), .01f, kUp);
  return scene;
}

/// Irradiance over radiance, by the closed forms: divided by pi in the picture.
void expect_form(const std::string& name, const SceneText& scene, double e_over_l,
                 int samples = 131072) {
  expect_exact(name, Probe(scene).onto(Vec3(0), kUp, 20, samples, .05f),
               static_cast<float>(e_over_l / kPi));
}

TEST(FormFactor, EmissiveSquaresAreFoundByLobeSampling) {
  const auto above = [](float half, float height, const Vec3& shift = Vec3(0)) {
    SceneText scene = card();
    scene.emitter("glow", 1).square("glow", Vec3(0, 0, height) + shift, half, -kUp);
    return scene;
  };
  expect_form("unit square at 1", above(.5f, 1), .7522747);
  expect_form("2x2 at 1", above(1, 1), .5541264 * kPi);
  expect_form("unit square at 2", above(.5f, 2), .0734776 * kPi, 524288);
  expect_form("unit square at 1, over its corner", above(.5f, 1, Vec3(.5f, .5f, 0)), .1385316 * kPi,
              262144);
  SceneText wall = card();
  wall.emitter("glow", 1).square("glow", Vec3(.5f, 1, .5f), .5f, Vec3(0, -1, 0));
  expect_form("unit square upright at 1, over its corner", wall, .0557342 * kPi, 524288);
  SceneText disc = card();
  std::vector<Vec3> rim;
  for (int i = 0; i < 360; ++i) {
    const float a = -kTwoPi * static_cast<float>(i) / 360;
    rim.emplace_back(.5f * std::cos(a), .5f * std::sin(a), 1);
  }
  disc.emitter("glow", 1).polygon("glow", rim);
  // The polygon's area is (n / 2 pi) sin(2 pi / n) of the disc's.
  expect_form("disc R .5 at 1", disc, .628319 * (1 - .4 / 360 / 360 * 6.58), 262144);
  SceneText ball = card();
  ball.emitter("glow", 1).sphere("glow", Vec3(0, 0, 1), .5f, 96);
  const Measured m = Probe(ball).onto(Vec3(0), kUp, 20, 262144, .05f);
  // The mesh lies inside of the sphere: its outline is that of a polygon of 192 corners.
  EXPECT_NEAR(m.mean.x, .25f, .25f * 2e-4f + 4 * m.error.x);
  figure("glowing sphere R .5 at 1", .25, m.mean.x, m.error.x);
}

TEST(FormFactor, SkyThroughAWindowAndOverAWall) {
  SceneText window = card();
  window.uniform_sky(1).lambert("dark", 0);
  // Four boards around a unit hole at height 1, wide enough to hide the rest of the sky.
  constexpr float kFar = 2000;
  const auto board = [&](float x0, float y0, float x1, float y1) {
    window.polygon("dark", {Vec3(x0, y0, 1), Vec3(x1, y0, 1), Vec3(x1, y1, 1), Vec3(x0, y1, 1)});
  };
  board(-kFar, -kFar, kFar, -.5f);
  board(-kFar, .5f, kFar, kFar);
  board(-kFar, -.5f, -.5f, .5f);
  board(.5f, -.5f, kFar, .5f);
  expect_form("sky through a unit window at 1", window, .7522747);
  SceneText wall = card();
  wall.uniform_sky(1).lambert("dark", 0).polygon(
      "dark", {Vec3(.001f, -kFar, -1), Vec3(.001f, kFar, -1), Vec3(.001f, kFar, kFar),
               Vec3(.001f, -kFar, kFar)});
  expect_exact("sky half hidden by a wall",
               Probe(wall).ray(Vec3(-.01f, 0, .05f), Vec3(.0098f, 0, -.05f), 131072), .5f);
  SceneText half = card();
  half.half_sky(1, Vec3(1, 0, 0));
  expect_form("half sky", half, kPi / 2);
}

/// physical_light of energy 4 pi^2 gives pi L with L = 1 / area' (see runtime/light.h).
std::string physical(float energy) {
  return fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} )", energy);
}

// acceptance: H4
TEST(AreaLight, PointLightDecaysBySquare) {
  for (const float d : {.5f, 1.0f, 2.0f, 4.0f}) {
    SceneText scene = card();
    scene.light("lamp", physical(4 * kPi) + fmt::format(" origin 0 0 {}", d));
    expect_exact(fmt::format("physical point light at {}", d),
                 Probe(scene).onto(Vec3(0), kUp, 60, 64, .02f), 1 / (d * d));
  }
  SceneText slanted = card();
  slanted.light("lamp", physical(4 * kPi) + " origin 1 0 1");
  expect_exact("physical point light at 45 degrees", Probe(slanted).onto(Vec3(0), kUp, 0, 64, .02f),
               .5f * std::sqrt(.5f));
}

// acceptance: H4, H6
TEST(AreaLight, ShapesMatchTheirFormFactors) {
  // Energy c: a point light brings pi c / (4 pi d^2); as a shape its radiance is c / (4 area), with
  // the projected area for spheres (pi R^2) and of cylinders (pi R times the half length).
  struct Case {
    const char* name;
    std::string area;
    float area_size, e_over_l;
  };
  const float disc_e = kPi * .25f / 1.25f;
  const Case cases[] = {
      {"rectangle 1x1", "direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3", 1, .7522747f},
      {"rectangle 2x2", "direction 0 0 -1 rectangle 2 0 0 0 2 0 3 3", 4, .5541264f * kPi},
      {"disc R .5", "disc 0 0 -1 .5 3 3", kPi * .25f, disc_e},
      {"sphere R .5", "sphere .5 3 3", kPi * .25f, kPi * .25f},
  };
  for (const Case& c : cases)
    for (const char* flags : {"", "visible on"})
      for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
        SceneText scene = card();
        scene.light("lamp", physical(4 * c.area_size * kPi) + " origin 0 0 1 " + c.area, flags);
        expect_exact(fmt::format("{} light, estimator {}, {}", c.name, static_cast<int>(e), flags),
                     Probe(scene).estimator(e).onto(Vec3(0), kUp, 20, 65536, .05f), Rgb(c.e_over_l),
                     .006f);
      }
}

// acceptance: H4
TEST(AreaLight, FarShapesActAsPoints) {
  constexpr float kDistance = 30;
  for (const char* area : {"direction 0 0 -1 rectangle .5 0 0 0 .5 0 3 3", "disc 0 0 -1 .3 3 3",
                           "sphere .3 3 3", "cylinder 1 0 0 .1 3 3"}) {
    SceneText scene = card();
    scene.light("lamp", physical(4 * kPi * kDistance * kDistance) +
                            fmt::format(" origin 0 0 {} ", kDistance) + area);
    const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 65536, .05f);
    figure(std::string("far light, ") + area, 1, m.mean.x, m.error.x);
    // A cylinder seen from its side has 4 R l of its mean projected area pi R l in view; being as
    // long as wide it is not quite a point yet.
    const bool cylinder = std::string_view(area).starts_with("cyl");
    EXPECT_NEAR(m.mean.x, cylinder ? 4 / kPi : 1, cylinder ? .003f : .001f) << area;
  }
}

// acceptance: H6
TEST(AreaLight, CylinderEqualsItsStrips) {
  // Infinite cylinder of radiance L, radius R at height d over the card: E = pi L R / d.
  SceneText scene = card();
  constexpr float kHalf = 400, kRadius = .2f;
  const float area = kPi * kRadius * kHalf;
  scene.light("lamp", physical(4 * kPi * area) +
                          fmt::format(" origin 0 0 1 cylinder {} 0 0 {} 3 3", kHalf, kRadius));
  for (const Estimator e : {Estimator::Mis, Estimator::BsdfOnly})
    expect_exact("long cylinder R .2 at 1",
                 Probe(scene).estimator(e).onto(Vec3(0), kUp, 0, 262144, .05f), kPi * kRadius,
                 .01f);
}

TEST(AreaLight, LightBehindAPaneIsFoundOnce) {
  // A thin pane of R = 2r / (1 + r) between card and light, and a pane behind the light.
  for (const float pane : {.6f, 1.2f})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      SceneText scene = card();
      scene
          .material("pane",
                    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                    "\"refr_color\" .5 .5 .5, \"thin_walled\" on")
          .square("pane", Vec3(0, 0, pane), 50, kUp)
          .light("lamp",
                 physical(4 * kPi) + " origin 0 0 1 direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3");
      expect_exact(
          fmt::format("lamp at 1, half pane at {}, estimator {}", pane, static_cast<int>(e)),
          Probe(scene).estimator(e).onto(Vec3(0), kUp, 0, 65536, .05f),
          .7522747f * (pane < 1 ? .5f : 1.0f), .006f);
    }
}

// acceptance: T10
TEST(Translucency, TranslucentSheetShowsTheLightBehindIt) {
  const auto from_below = [](const SceneText& scene, int samples) {
    return Probe(scene).ray(Vec3(-.25f, 0, -.433f), Vec3(.25f, 0, .433f), samples);
  };
  // R = 0: transparency .8, of which the weight becomes translucency of colour .5 .6 .7.
  for (const float weight : {0.0f, .25f, .5f, 1.0f}) {
    const std::string sheet = fmt::format(
        "\"reflectivity\" 0, \"diffuse\" 1 1 1, \"transparency\" .8, \"refr_translucency\" on, "
        "\"refr_trans_weight\" {}, \"refr_trans_color\" .5 .6 .7, \"thin_walled\" on",
        weight);
    const Rgb bled = Rgb(.5f, .6f, .7f) * (.8f * weight);
    SceneText sun;
    sun.material("sheet", sheet)
        .square("sheet", Vec3(0), 5, kUp)
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction .6 0 -.8");
    expect_exact(fmt::format("sheet lit from behind by the sun, weight {}", weight),
                 from_below(sun, 64), bled * .8f);
    SceneText sky;
    sky.half_sky(1, kUp).material("sheet", sheet).square("sheet", Vec3(0), 5, kUp);
    expect_exact(fmt::format("sheet before a sky, weight {}", weight), from_below(sky, 65536),
                 bled + Rgb(.8f * (1 - weight)));
  }
}

}  // namespace light_test
}  // namespace oriel::testing
