// SPDX-License-Identifier: Apache-2.0
// Lights with a shape, glowing meshes and portals that move: against form factors in the mean over
// the shutter, against still pictures, and samples of lights against rays that find them. All
// within 4 standard errors: one in 16000 by chance.
#include "motion_scenes.h"
#include "support/portal_scenes.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace motion_light_test {

constexpr Estimator kEstimators[] = {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly};
constexpr const char* kShutter = "trace depth 8 8 12 shadow segments motion steps 15 shutter 1";

/// Instance statements for the position of a light.
std::string text_of(const Mat4& to_world) {
  const Mat4 m = to_world.inverse();
  std::string text;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) text += fmt::format(" {}", m[row][column]);
  return text;
}

/// A turn, and then a shift.
Mat4 turn(const Vec3& axis, float degrees, const Vec3& by) {
  Mat4 m, shift;
  m.setAxisAngle(Imath::V3f(normalize(axis)), degrees * kPi / 180);
  shift.setTranslation(Imath::V3f(by));
  return m * shift;
}

/// Form factor of a rectangle at height 1 over a card at the origin.
/// Source:  J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
double form_factor(double x0, double x1, double y0, double y1) {
  const auto corner = [](double a, double b) {
    const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
    return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * M_PI);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

/// Mean over the time 0 to 1.
template <class F>
float mean_over_time(const F& f) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += f((i + .5) / kSteps) / kSteps;
  return static_cast<float>(sum);
}

/// The card of light_test.cpp, while the shutter is open.
SceneText card(const std::string& options = kShutter) {
  SceneText scene(options);
  scene.lambert("card", 1).square("card", Vec3(0), .01f, kUp);
  return scene;
}
Measured on_card(const Probe& probe, int samples) {
  return seen(probe, Vec3(0, .017f, .047f), Vec3(0, -.017f, -.047f), samples);
}

/// physical_light of this energy shows a white card pi times the form factor.
std::string lamp(float area, const std::string& shape) {
  const float energy = 4 * kPi * area;
  return fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin 0 0 1 {1}", energy,
                     shape);
}

TEST(MovingLights, MatchTheMeanFormFactorInEachEstimator) {
  const auto unit = [](double x, double y, double half_x, double half_y) {
    return M_PI * form_factor(x - half_x, x + half_x, y - half_y, y + half_y);
  };
  Mat4 wider;
  wider.setScale(Imath::V3f(2.5f, 1.5f, 1));
  const struct {
    const char* name;
    Mat4 end;
    float exact;
  } kCases[] = {{"shifted", turn(kUp, 0, Vec3(2, -1, 0)),
                 mean_over_time([&](double t) { return unit(2 * t, -t, .5, .5); })},
                // What grows keeps its radiance.
                {"stretched", wider,
                 mean_over_time([&](double t) { return unit(0, 0, .5 + .75 * t, .5 + .25 * t); })}};
  for (const auto& c : kCases)
    for (const char* flags : {"", "visible on "})
      for (const Estimator e : kEstimators) {
        SceneText scene = card();
        scene.light("lamp", lamp(1, "direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3"),
                    std::string(flags) + "motion transform" + text_of(c.end));
        expect_exact(fmt::format("{} lamp, {}estimator {}", c.name, flags, static_cast<int>(e)),
                     on_card(Probe(scene).estimator(e), 1 << 16), c.exact, .012f);
      }
}

TEST(MovingLights, AreTheMeanOfStillPicturesAndRaysFindWhatSamplesBring) {
  const struct {
    const char* shape;
    float area;
  } kShapes[] = {{"direction 0 0 -1 rectangle 1 0 .1 .3 1 0 3 3", 1},
                 {"disc 0 0 -1 .5 3 3", kPi * .25f},
                 {"sphere .4 3 3", kPi * .16f},
                 {"cylinder .5 0 .1 .3 3 3", kPi * .15f}};
  const Vec3 axis(1, 2, -.5f), by(.8f, -.4f, .3f);
  // Near the light, which rotates toward the card and away from it.
  const auto at = [&](float time) {
    return turn(kUp, 0, Vec3(0, 0, -1)) * turn(axis, 80 * time, Vec3(0, 0, 1) + by * time);
  };
  for (const auto& s : kShapes) {
    constexpr int kStills = 24;
    Measured stills;
    for (int i = 0; i < kStills; ++i) {
      SceneText scene = card("");
      scene.light("lamp", lamp(s.area, s.shape),
                  "transform" + text_of(at((static_cast<float>(i) + .5f) / kStills)));
      const Measured m = Probe(scene).estimator(Estimator::LightOnly).onto(Vec3(0), kUp, 20, 1024);
      stills.mean += m.mean / kStills;
      stills.error += m.error * m.error / sqr(kStills * 1.0f);
    }
    for (int k = 0; k < 3; ++k) stills.error[k] = std::sqrt(stills.error[k]);
    for (const Estimator e : kEstimators) {
      SceneText scene = card();
      // The origin of the instance moves on a straight line: the position of the light.
      std::string element = lamp(s.area, s.shape);
      element.replace(element.find("0 0 1"), 5, "0 0 0");
      scene.light("lamp", element,
                  "visible on transform" + text_of(turn(kUp, 0, Vec3(0, 0, 1))) +
                      " motion transform" + text_of(turn(axis, 80, Vec3(0, 0, 1) + by)));
      const Measured m = on_card(Probe(scene).estimator(e), 1 << 16);
      const float error = std::hypot(m.error.x, stills.error.x);
      EXPECT_LT(error, .012f * stills.mean.x) << s.shape;
      // Between steps of 6 degrees the light shrinks by up to 1 - cos(3 degrees).
      EXPECT_NEAR(m.mean.x, stills.mean.x, 4 * error + .0015f * stills.mean.x)
          << s.shape << " estimator " << static_cast<int>(e);
      figure(std::string("moving light, ") + s.shape, stills.mean.x, m.mean.x, error);
    }
  }
}

TEST(MovingLights, EmissiveMeshesMatchTheMeanFormFactor) {
  const float exact =
      mean_over_time([](double t) { return form_factor(2 * t - .5, 2 * t + .5, -t - .5, .5 - t); });
  for (const bool sampled : {true, false}) {
    SceneText scene = card();
    scene.emitter("glow", 1).polygon(
        "glow", {{-.5f, -.5f, 1}, {-.5f, .5f, 1}, {.5f, .5f, 1}, {.5f, -.5f, 1}},
        "motion transform" + text_of(turn(kUp, 0, Vec3(2, -1, 0))));
    expect_exact("glowing mesh", on_card(Probe(scene).mesh_lights(sampled), 1 << 17), exact, .012f);
  }
  // One that turns away, of a disc and its copy, against rays alone.
  SceneText turning = card();
  turning.emitter("glow", 1).polygon(
      "glow", {{-.5f, -.5f, 0}, {-.5f, .5f, 0}, {.5f, .5f, 0}, {.5f, -.5f, 0}},
      "transform" + text_of(turn(kUp, 0, kUp)) + " motion transform" +
          text_of(turn(Vec3(1, 1, 0), 120, Vec3(.5f, .5f, 1))));
  expect_same("turning mesh", on_card(Probe(turning), 1 << 16),
              on_card(Probe(turning).mesh_lights(false), 1 << 18), .01f);
}

/// Motions of portals: translation, rotation and deformation.
std::vector<Mat4> portal_ways() {
  Mat4 wider;
  wider.setScale(Imath::V3f(1, 1.5f, .7f));
  return {turn(kUp, 0, Vec3(.3f, .8f, -.4f)), turn(Vec3(0, 1, 3), 35, Vec3(-.2f, .3f, .1f)), wider};
}

TEST(MovingPortals, WithTheSkyAroundThemAddUpToOne) {
  for (const Mat4& way : portal_ways())
    for (const Estimator e : kEstimators) {
      SceneText scene(kShutter);
      add_portal(scene, "window", Vec3(0), 2, 2);
      scene.group("car", "motion transform" + text_of(way));
      scene.uniform_sky(1).lambert("card", 1).square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
      Probe probe = probe_of(scene);
      probe.estimator(e);
      EXPECT_FALSE(probe.world().lights.at(0).path.empty());
      expect_exact("window and the sky around it",
                   seen(probe, {.95f, .01f, 0}, {.05f, -.01f, 0}, 1 << 15), 1, .006f);
    }
}

TEST(MovingPortals, MatchTheMeanFormFactor) {
  const float exact = mean_over_time(
      [](double t) { return form_factor(.8 * t - 1, .8 * t + 1, -.4 * t - 1, 1 - .4 * t); });
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly}) {
    SceneText scene(kShutter);
    add_portal(scene, "window", Vec3(0), 2, 2);
    scene.group("car", "motion transform" + text_of(turn(kUp, 0, Vec3(0, .8f, -.4f))));
    scene.uniform_sky(1).lambert("card", 1).square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
    expect_exact("moving window, direct",
                 seen(probe_of(scene).estimator(e).direct_only(), {.95f, .01f, 0}, {.05f, -.01f, 0},
                      1 << 15),
                 exact, .006f);
  }
}

/// The room of the portal tests, with this motion while the shutter is open.
Probe moving_room(const char* environment, const Mat4& way, bool portals, float albedo = .5f) {
  SceneText scene = room(environment, albedo);
  if (portals) add_window(scene);
  scene.group("car", "motion transform" + text_of(way));
  std::string text = scene.str();
  text.replace(text.find("trace on "), 9, "trace on shutter 1 motion steps 6 ");
  return Probe(text, registry());
}

TEST(MovingPortals, RoomsThatMoveHaveTheLightOfTheirOpenWindow) {
  // On the floor, and at the light as seen through the window.
  const struct {
    const char* environment;
    Vec3 eye, direction;
  } kCases[] = {{kSky, {2, .3f, 1}, {.1f, 0, -1}}, {kLamps, {3, .9f, .7f}, {1, 0, 0}}};
  for (const auto& c : kCases)
    for (const Mat4& way : {turn(kUp, 0, Vec3(.3f, .2f, .2f)), turn(kUp, 10, Vec3(.2f, 0, .2f))}) {
      const auto lit = [&](bool portals, int samples) {
        return seen(moving_room(c.environment, way, portals), c.eye, c.direction, samples);
      };
      expect_same(c.environment, lit(true, 1 << 13), lit(false, 1 << 15), .03f);
    }
}

TEST(MovingPortals, PhotonsAgreeWithTheirDirectLight) {
  for (const Mat4& way : portal_ways()) {
    const auto probe_with = [&way](const char* photons) {
      SceneText scene(kShutter);
      add_portal(scene, "window", Vec3(0, 0, 1.5f), 1.4f, 1.2f, photons);
      scene.group("car", "motion transform" + text_of(way));
      scene.environment(kSky).lambert("card", 1).square("card", Vec3(2, 0, 0), 1.5f, kUp);
      return probe_of(scene);
    };
    const Probe probe = probe_with("");
    const Measured direct = Probe(probe_with(""))
                                .direct_only()
                                .estimator(Estimator::LightOnly)
                                .over(1 << 15, [&](sampling::Sampler& sampler, int) {
                                  const float time = probe.world().shutter.at(sampler.next_1d());
                                  const Vec2 u = sampler.next_2d();
                                  const Vec3 eye(.5f + 3 * u.x, 3 * u.y - 1.5f, .001f);
                                  return std::pair(Camera::Ray{eye, -kUp, 1, 0, 0, time}, Vec2(0));
                                });
    const Probe photons = probe_with("\"emit_direct_photons\" on");
    constexpr int kMaps = 16;
    std::vector<double> each(kMaps);
    for (int i = 0; i < kMaps; ++i) {
      PhotonSettings settings;
      settings.each.global.emit = 20000;
      settings.seed = static_cast<std::uint32_t>(i);
      settings.depth = {0, 0, 0};
      RayCounts counts;
      const PhotonMaps maps = trace_photons(photons.world(), settings, counts);
      for (const Photon& p : maps.global.photons())
        each[static_cast<std::size_t>(i)] += static_cast<double>(p.power.y) / (9 * M_PI);
    }
    double mean = 0, variance = 0;
    for (const double x : each) mean += x / kMaps;
    for (const double x : each) variance += (x - mean) * (x - mean) / (kMaps * (kMaps - 1));
    const double error = std::hypot(std::sqrt(variance), static_cast<double>(direct.error.y));
    EXPECT_LT(error, .01 * static_cast<double>(direct.mean.y));
    EXPECT_NEAR(mean, direct.mean.y, 4 * error);
    figure("photons of a moving portal", direct.mean.y, mean, error);
  }
}

TEST(MovingPortals, PhotonsOfTheSkyDoNotComeThroughAsWell) {
  const auto arriving = [](bool portals) {
    const Probe probe = moving_room(kSky, turn(kUp, 25, Vec3(.2f, 0, .2f)), portals, .001f);
    PhotonSettings settings;
    settings.environment.global.emit = 100000;
    settings.environment.caustic.emit = 0;
    RayCounts counts;
    double sum = 0;
    const PhotonMaps maps = trace_photons(probe.world(), settings, counts);
    for (const Photon& p : maps.global.photons()) sum += static_cast<double>(p.power.y);
    return sum;
  };
  EXPECT_LT(arriving(true), .01 * arriving(false));
}

}  // namespace motion_light_test
}  // namespace oriel::testing
