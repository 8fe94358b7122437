// SPDX-License-Identifier: Apache-2.0
// Irradiance sensors at points with illuminance in closed form.
#include "analysis/measure.h"
#include "color/luminance.h"
#include "support/probe.h"

namespace oriel::testing {
namespace measure_test {

constexpr float kFar = 2000;  ///< how wide boards are that hide the rest of the sky

/// Standard errors in half an interval: Student's factor for many batches, rounded down.
constexpr double kErrorsInInterval = 1.95;

/// |reading - exact| <= 4 standard errors, for a reading that is precise enough.
void expect_reads(const std::string& name, const Reading& r, double exact,
                  double precision = .006) {
  EXPECT_NEAR(r.value, exact, 4 / kErrorsInInterval * r.half_width + kRounding * exact) << name;
  EXPECT_LE(r.half_width, precision * exact) << name << ": too noisy to show anything";
  figure(name, exact, r.value, r.half_width / kErrorsInInterval);
}

/// One meter, with a pixel unit of 1 cd/m2.
Reading measure(const SceneText& scene, const IrradianceSensor& meter,
                const MeasureRequest& request = {.precision = .005}) {
  return measure_illuminance(Probe(scene).world(), {meter}, 1, request).front();
}
const IrradianceSensor kMeter{Vec3(0), kUp};

/// A dark board in the plane z with a hole of that half width and centre.
SceneText& board_with_hole(SceneText& scene, float z, float half, const Vec3& c = Vec3(0)) {
  const auto piece = [&](float x0, float y0, float x1, float y1) {
    scene.polygon("dark", {Vec3(x0, y0, z), Vec3(x1, y0, z), Vec3(x1, y1, z), Vec3(x0, y1, z)});
  };
  piece(-kFar, -kFar, kFar, c.y - half);
  piece(-kFar, c.y + half, kFar, kFar);
  piece(-kFar, c.y - half, c.x - half, c.y + half);
  piece(c.x + half, c.y - half, kFar, c.y + half);
  return scene;
}

TEST(Measure, UniformSkyGivesPiTimesItsLuminance) {
  SceneText open;
  open.uniform_sky(1000).lambert("dark", 0).square("dark", Vec3(0, 0, -5), 1, kUp);
  expect_reads("uniform sky, 1000 cd/m2", measure(open, kMeter), 1000 * kPi);
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), normalize(Vec3(1, 2, 3))})
    expect_reads("in any direction", measure(open, {Vec3(3, 1, 2), n}), 1000 * kPi);
  SceneText wall = open;
  wall.polygon("dark", {Vec3(.001f, -kFar, -1), Vec3(.001f, kFar, -1), Vec3(.001f, kFar, kFar),
                        Vec3(.001f, -kFar, kFar)});
  expect_reads("half hidden by a wall", measure(wall, kMeter), 1000 * kPi / 2);
}

TEST(Measure, WindowsMatchTheirFormFactor) {
  SceneText window;
  window.uniform_sky(1000).lambert("dark", 0);
  board_with_hole(window, 1, .5f);
  expect_reads("unit window at 1", measure(window, kMeter), 752.2747);
  expect_reads("from below", measure(window, {Vec3(0, 0, 2), -kUp}), 752.2747);
  const struct {
    const char* name;
    Vec3 centre;
    float half, height;
    double factor;  ///< of the element under it
  } kRoofs[] = {{"2x2 at 1", Vec3(0), 1, 1, .5541264},
                {"1x1 at 2", Vec3(0), .5f, 2, .0734776},
                {"1x1 at 1, under its corner", Vec3(.5f, .5f, 0), .5f, 1, .1385316}};
  for (const auto& roof : kRoofs) {
    SceneText scene;
    scene.uniform_sky(100).lambert("dark", 0);
    board_with_hole(scene, roof.height, roof.half, roof.centre);
    expect_reads(roof.name, measure(scene, kMeter), 100 * kPi * roof.factor);
  }
}

TEST(Measure, ASquareAtTheFootOfAWallLightsItByItsFormFactor) {
  // A unit square at height 1 over the foot of the wall, one corner above the meter.
  SceneText scene;
  scene.emitter("glow", 1000)
      .polygon("glow", {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 0, 1)});
  expect_reads("1x1 at 1, from an upright element under its corner",
               measure(scene, {Vec3(0), Vec3(1, 0, 0)}, {.precision = .01}), 1000 * kPi * .0557342,
               .011);
}

TEST(Measure, FiniteLightsMatchTheirShapes) {
  // A physical light of colour c sends pi c in all: 1000 cd are c = 4000.
  const auto lamp = [](const std::string& element, float color) {
    SceneText scene;
    return scene.light(
        "lamp", fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) {1}", color, element));
  };
  for (const float d : {.5f, 2.0f}) {
    const SceneText above = lamp(fmt::format("origin 0 0 {}", d), 4000);
    expect_reads(fmt::format("1000 cd at {}", d), measure(above, kMeter), 1000 / (d * d));
    const IrradianceSensor tilted{Vec3(0), Vec3(0, std::sqrt(.75f), .5f)};
    expect_reads("at 60 degrees", measure(above, tilted), 500 / (d * d));
    EXPECT_EQ(measure(above, {Vec3(0), -kUp}).value, 0);
  }
  // Shapes that emit on both sides, L = 1000.
  SceneText disc, ball;
  std::vector<Vec3> rim;
  for (int i = 0; i < 360; ++i) {
    const float a = kTwoPi * static_cast<float>(i) / 360;
    rim.emplace_back(std::cos(a), -std::sin(a), 1);
  }
  disc.emitter("glow", 1000).polygon("glow", rim);
  // The area of 360 corners is that much less than the circle's.
  expect_reads("disc R 1 at 1", measure(disc, kMeter), 1570.796 * (1 - 2.5e-5));
  // Its outline is that of a polygon of 192 corners.
  ball.emitter("glow", 1000).sphere("glow", Vec3(0, 0, 1), .6f, 96);
  expect_reads("sphere R .6 at 1", measure(ball, kMeter), 1000 * kPi * .36 * (1 - 2e-4));
}

TEST(Measure, OvercastSkyThroughARoundRoofLight) {
  const struct {
    float half_angle;
    double share;  ///< E over the zenith's luminance
  } kOpenings[] = {{30, .751163}, {60, 2.007129}};
  for (const auto& opening : kOpenings) {
    SceneText scene;
    scene
        .environment(
            "\"mia_ciesky\" ( \"rgb_unit_conversion\" .31830989 .31830989 .31830989, "
            "\"zenith_luminance\" 5000, \"overcast\" 1 )")
        .lambert("dark", 0);
    constexpr int kCorners = 720;
    const float r = std::tan(opening.half_angle * kPi / 180);
    const auto at = [&](int i, float radius) {
      const float a = kTwoPi * static_cast<float>(i) / kCorners;
      return Vec3(radius * std::cos(a), radius * std::sin(a), 1);
    };
    for (int i = 0; i < kCorners; ++i)
      scene.polygon("dark", {at(i, r), at(i, kFar), at(i + 1, kFar), at(i + 1, r)});
    expect_reads(fmt::format("CIE overcast, {} degrees", opening.half_angle),
                 measure(scene, kMeter), 5000 * opening.share);
    const float open = luminance(open_sky_irradiance(Probe(scene).world(), kUp));
    EXPECT_NEAR(open, 5000 * 7 * kPi / 9, 5);
  }
}

TEST(Measure, SunThroughAHoleMatchesItsFlux) {
  // 92372 lx facing the sun at 45 degrees through 1 m2 of a horizontal board.
  const Vec3 to_sun = normalize(Vec3(1, 0, 1));
  SceneText scene;
  scene.lambert("dark", 0).light(
      "sun", fmt::format("\"mia_physicalsun\" ( \"rgb_unit_conversion\" .31830989 .31830989 "
                         ".31830989, \"shadow_softness\" 1 ) direction {}",
                         text_of(-to_sun)));
  board_with_hole(scene, 1, .5f);
  const Probe probe(scene);
  // Sensors whose place is drawn with each sample: the mean over 4 m2 of floor under the hole.
  const auto floor = [&](std::size_t, sampling::Sampler& sampler, RayCounts& counts) {
    const Vec2 u = sampler.next_2d();
    const IrradianceSensor meter{Vec3(-2 + 2 * u.x, -1 + 2 * u.y, 0), kUp};
    return double{luminance(sample_irradiance(probe.world(), meter, {}, sampler, counts))};
  };
  const Reading r = take_readings(1, floor, {.precision = .005}).front();
  const double exact = 92372 * std::sqrt(.5) / 4;
  // Of the tabulated sun 1e-3 is not known.
  EXPECT_NEAR(r.value, exact, 2.1 * r.half_width + 1e-3 * exact);
  figure("sun through 1 m2, mean over 4 m2", exact, r.value, r.half_width / kErrorsInInterval);
  const Reading lit = measure(scene, {Vec3(-1, 0, 0), kUp});
  EXPECT_NEAR(lit.value, 65317, 70);
  EXPECT_EQ(measure(scene, {Vec3(0, 0, 0), kUp}).value, 0);
}

// By flux conservation: a lamp of flux F in a closed room of area S and albedo r brings F / S of
// direct and F r / (S (1 - r)) of indirect light to the walls in the mean, which six equal ones
// share.
TEST(Measure, IntegratingCubeKeepsItsFlux) {
  const auto wall = [](float albedo, bool indirect) {
    SceneText scene("trace depth 8 8 12 shadow segments");
    scene.lambert("grey", albedo).box("grey", Vec3(-2), Vec3(2), true);
    scene.light("lamp", fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin 0 0 0",
                                    10000 / kPi));
    const Probe probe(scene);
    PathSettings settings;
    settings.indirect = indirect;
    const auto anywhere = [&](std::size_t, sampling::Sampler& sampler, RayCounts& counts) {
      const Vec2 u = sampler.next_2d();
      const IrradianceSensor meter{Vec3(4 * u.x - 2, 4 * u.y - 2, -2), kUp, 1e-4f};
      return double{luminance(sample_irradiance(probe.world(), meter, settings, sampler, counts))};
    };
    return take_readings(1, anywhere, {.precision = .004}).front();
  };
  expect_reads("cube, direct", wall(.5f, false), 104.1667);
  const struct {
    float albedo;
    double indirect;
  } kCases[] = {{.2f, 26.0417}, {.5f, 104.1667}, {.8f, 416.667}, {.9f, 937.5}};
  for (const auto& c : kCases)
    expect_reads(fmt::format("cube, albedo {}, all light", c.albedo), wall(c.albedo, true),
                 104.1667 + c.indirect);
}

TEST(Measure, NinetyFiveOfAHundredIntervalsHoldTheClosedForm) {
  SceneText scene;
  scene.uniform_sky(1000).lambert("dark", 0);
  board_with_hole(scene, 1, .5f);
  const Probe probe(scene);
  constexpr int kSeeds = 200, kMeters = 4;
  int held = 0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
    for (const Reading& r :
         measure_illuminance(probe.world(), std::vector<IrradianceSensor>(kMeters, kMeter), 1,
                             {.precision = .03, .seed = seed}))
      held += std::abs(r.value - 752.2747) <= r.half_width;
  // Four sigma of the binomial distribution.
  constexpr double kAll = kSeeds * kMeters;
  EXPECT_NEAR(held, .95 * kAll, 4 * std::sqrt(kAll * .95 * .05));
  if (std::getenv("ORIEL_FIGURES")) fmt::print("| intervals that hold | {} of {} |\n", held, kAll);
}

}  // namespace measure_test
}  // namespace oriel::testing
