// SPDX-License-Identifier: Apache-2.0
// First hits of photons compared with direct light, for all kinds of lights.
#include "lights/light_sampler.h"
#include "lights/photon_source.h"

#include <fstream>

#include "base/parallel.h"
#include "support/probe.h"

namespace oriel::testing {
namespace photon_emission_test {

std::string physical(float energy) {
  return fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} )", energy);
}

/// A rectangle on which photons and direct light are compared, without any blockers.
struct Card {
  Vec3 centre, edge_u, edge_v;
  Vec3 normal() const { return normalize(cross(edge_u, edge_v)); }
  float area() const { return length(cross(edge_u, edge_v)); }
};

/// Mean over groups, with the spread of the groups as error.
struct Estimate {
  double mean = 0, error = 0;
};
template <class F>
Estimate estimate(int samples, const F& f) {
  constexpr int kGroups = 16;
  std::vector<double> means(kGroups);
  parallel_for(kGroups, [&](std::size_t g) {
    for (int i = 0; i < samples / kGroups; ++i) {
      sampling::Sampler s(static_cast<int>(g), 3, static_cast<std::uint32_t>(i));
      means[g] += double(f(s)) / (samples / kGroups);
    }
  });
  Estimate e;
  for (const double m : means) e.mean += m / kGroups;
  for (const double m : means) e.error += (m - e.mean) * (m - e.mean);
  e.error = std::sqrt(e.error / (kGroups - 1) / kGroups);
  return e;
}

/// Irradiance of the card's front from first hits.
Estimate by_photons(const PhotonSource& source, const Card& card, int samples = 1 << 20) {
  const Vec3 n = card.normal();
  return estimate(samples, [&](sampling::Sampler& s) {
    const Vec2 u_place = s.next_2d();
    const EmittedPhoton photon = source.emit(u_place, s.next_2d());
    const float cosine = -dot(photon.direction, n);
    if (!(cosine > 0)) return 0.0f;
    const float t = dot(photon.origin - card.centre, n) / cosine;
    if (!(t > 0)) return 0.0f;
    const Vec3 p = photon.origin + photon.direction * t - card.centre;
    if (std::abs(dot(p, card.edge_u)) > .5f * dot(card.edge_u, card.edge_u) ||
        std::abs(dot(p, card.edge_v)) > .5f * dot(card.edge_v, card.edge_v))
      return 0.0f;
    return source.power(photon, t).y / card.area();
  });
}

Estimate by_direct_light(const World& world, const Light* light, const Card& card) {
  return estimate(1 << 16, [&](sampling::Sampler& s) {
    ShadingPoint point;
    const Vec2 where = s.next_2d(), u = s.next_2d();
    point.position = card.centre + card.edge_u * (where.x - .5f) + card.edge_v * (where.y - .5f);
    point.normal = point.geometric_normal = card.normal();
    point.world = &world;
    if (light) {
      const auto sample = sample_light(*light, point, u);
      return sample ? sample->irradiance.y * std::max(0.0f, dot(sample->wi, point.normal)) : 0.0f;
    }
    const auto sample = world.light_sampler->environment().sample(point.normal, u);
    const Rgba radiance = environment_radiance(world.environment, world, point.position, sample.wi,
                                               RayKind::FinalGather);
    return radiance.g * std::max(0.0f, dot(sample.wi, point.normal)) / sample.pdf;
  });
}

/// The card lies flat at z = 0 but for a slant.
const Card kCard{Vec3(.2f, .1f, 0), Vec3(1, 0, .2f), Vec3(0, 1, 0)};
/// A box around it.
const geom::Box3 kAim(Vec3(-.5f, -.5f, -.2f), Vec3(.8f, .7f, .2f));

void expect_agreement(const std::string& name, const Light* light_or_sky, const World& world,
                      const EmissionRequest& request = {}) {
  const PhotonSource source =
      light_or_sky ? PhotonSource(world, *light_or_sky, request) : PhotonSource(world, request);
  const Estimate direct = by_direct_light(world, light_or_sky, kCard);
  const Estimate photons = by_photons(source, kCard);
  ASSERT_GT(direct.mean, 0) << name;
  EXPECT_LT(std::hypot(photons.error, direct.error), .008 * direct.mean) << name << ": too noisy";
  EXPECT_NEAR(photons.mean, direct.mean, 4 * std::hypot(photons.error, direct.error)) << name;
  EXPECT_NEAR(photons.mean, direct.mean, .02 * direct.mean) << name;
  figure(name, direct.mean, photons.mean, photons.error);
}

/// Something to aim at, 6 units wide.
SceneText stage() {
  SceneText scene;
  scene.lambert("grey", .5f).box("grey", Vec3(-3), Vec3(3), true);
  return scene;
}

// acceptance: H4
// acceptance: S14
TEST(PhotonEmission, FirstHitsMatchDirectLight) {
  const struct {
    const char* name;
    std::string element;
  } kCases[] = {
      {"point", physical(100) + " origin 0 0 2"},
      {"point, decay 1", physical(100) + " origin 0 0 2 exponent 1"},
      {"point without decay", "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 1.5"},
      {"point with a range",
       "\"mib_light_point\" ( \"color\" 1 1 1, \"atten\" on, \"start\" 1, \"stop\" 3 ) "
       "origin 0 .5 1.5"},
      {"spot",
       "\"physical_light\" ( \"color\" 9 9 9, \"cone\" .95 ) origin 0 0 2 direction .1 0 -1 "
       "spread .85"},
      {"spot without decay",
       "\"mib_light_spot\" ( \"color\" 1 1 1, \"cone\" .9 ) origin 1 0 2 direction -.3 0 -1 "
       "spread .7"},
      {"wide spot",
       "\"physical_light\" ( \"color\" 9 9 9, \"cone\" .2 ) origin 0 0 2 "
       "direction 1 0 -1 spread -.5"},
      {"directional", "\"mib_light_infinite\" ( \"color\" 2 2 2 ) direction .3 .2 -1"},
      {"sun",
       "\"mia_physicalsun\" ( \"rgb_unit_conversion\" 1 1 1, \"shadow_softness\" 20 ) "
       "direction .3 .2 -1"},
      {"rectangle", physical(9) + " origin 0 0 1 direction 0 0 -1 rectangle 1 0 0 0 2 0 3 3"},
      {"slanted rectangle",
       physical(9) + " origin 0 0 1 direction 0 0 -1 rectangle 1 0 .3 .5 1 0 3 3"},
      {"rectangle without cosine or decay",
       "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 1 direction 0 0 -1 "
       "rectangle 1 0 0 0 1 0 3 3"},
      {"rectangle with a spread",
       "\"physical_light\" ( \"color\" 9 9 9, \"cone\" .9 ) origin 0 0 1 direction 0 0 -1 "
       "spread .6 rectangle 1 0 0 0 1 0 3 3"},
      {"disc", physical(9) + " origin 0 0 1 disc 0 0 -1 .5 3 3"},
      {"sphere", physical(9) + " origin 0 0 1 sphere .5 3 3"},
      {"sphere without decay",
       "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 1 sphere .3 3 3"},
      {"cylinder", physical(9) + " origin 0 0 1 cylinder 1 0 .2 .25 3 3"},
  };
  for (const auto& c : kCases) {
    SceneText scene = stage();
    scene.light("lamp", c.element);
    const Probe probe(scene);
    expect_agreement(c.name, &probe.world().lights[0], probe.world());
  }
}

/// An asymmetric light, mostly downward, and its element.
std::string measured_lamp() {
  const std::string path = ::testing::TempDir() + "/oriel-emission.ies";
  std::ofstream(path) << "IESNA91\nTILT=NONE\n1 -1 1 5 3 1 2 0 0 0 1 1 40\n0 30 60 90 180\n"
                         "0 90 180\n9 8 3 1 0\n9 14 6 1 0\n9 5 1 0 0\n";
  return fmt::format("lightprofile \"lp\" format ies file \"{}\" end lightprofile", path);
}

// acceptance: H4, H6
TEST(PhotonEmission, MeasuredLightsSendByTheirProfile) {
  const std::string mib = "\"mib_light_photometric\" ( \"color\" 1 1 1, \"profile\" \"lp\" ) ";
  const std::string mia =
      "\"mia_photometric_light\" ( \"distribution_mode\" 2, \"profile\" \"lp\", "
      "\"intensity_mode\" 1, \"manual_flux_lm\" 80 ) energy 1 1 1 ";
  const std::string down = "direction .1 0 -1 spread -1 ";
  const struct {
    const char* name;
    std::string element;
    bool even;  // all photons that come out are equally strong
  } kCases[] = {
      {"measured point", mib + "origin 0 0 1.5", true},
      {"measured point by flux", mia + "origin 0 0 1.5", true},
      {"measured spot", mib + "origin 0 0 2 direction .1 0 -1 spread .8", true},
      {"measured point, decay 1", mib + "origin 0 0 1.5 exponent 1", false},
      {"physical point by profile", physical(100) + " origin 0 0 1.5 lightprofile \"lp\"", true},
      {"measured rectangle", mib + "origin 0 0 1 " + down + "rectangle 1 0 .1 0 2 0 3 3", true},
      {"measured disc", mib + "origin 0 0 1 " + down + "disc 0 0 -1 .5 3 3", true},
      {"measured sphere", mib + "origin 0 0 1 " + down + "sphere .5 3 3", true},
      {"measured cylinder", mib + "origin 0 0 1 " + down + "cylinder 1 0 .2 .25 3 3", true},
      {"spot by cosine",
       "\"mia_photometric_light\" ( \"distribution_mode\" 1, \"spotlight_cosine_bias\" 3, "
       "\"manual_peak_intensity_cd\" 9 ) origin 0 0 2 direction 0 0 -1 spread .7",
       false},
  };
  for (const auto& c : kCases) {
    SceneText scene = stage();
    scene.statement(measured_lamp()).light("lamp", c.element);
    const Probe probe(scene);
    const Light& light = probe.world().lights[0];
    expect_agreement(c.name, &light, probe.world(), light.photons.emission);
    if (!c.even) continue;
    const PhotonSource source(probe.world(), light, light.photons.emission);
    float power = 0;
    for (int i = 0; i < 1000; ++i) {
      sampling::Sampler s(i, 0, 0);
      const Vec2 u = s.next_2d();
      const float here = source.power(source.emit(u, s.next_2d()), 1).y;
      if (here <= 0) continue;  // the side that a flat shape keeps back
      if (power == 0) power = here;
      ASSERT_NEAR(here, power, .01f * power) << c.name;
    }
    EXPECT_GT(power, 0) << c.name;
  }
  // The requested flux is emitted, in units of pi per colour.
  SceneText scene = stage();
  scene.statement(measured_lamp()).light("lamp", mia + "origin 0 0 1");
  const Probe probe(scene);
  EXPECT_NEAR(PhotonSource(probe.world(), probe.world().lights[0]).estimate_flux(64).y, 80, .05);
}

// acceptance: H4
TEST(PhotonEmission, EnvironmentMatchesItsDirectLight) {
  for (const bool half : {false, true}) {
    SceneText scene = stage();
    if (half)
      scene.half_sky(2, Vec3(1, .5f, 1));
    else
      scene.uniform_sky(1);
    const Probe probe(scene);
    expect_agreement(half ? "half sky" : "uniform sky", nullptr, probe.world(), {.aim = kAim});
    if (half) continue;
    const Card level{Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
    const Estimate e = by_photons(PhotonSource(probe.world()), level);
    EXPECT_NEAR(e.mean, kPi, 4 * e.error);
    EXPECT_LT(e.error, .02 * kPi);
  }
}

// acceptance: S14
TEST(PhotonEmission, BoundingBoxChangesOnlyPhotonDirections) {
  SceneText scene = stage();
  scene.light("sun", "\"mib_light_infinite\" ( \"color\" 2 2 2 ) direction .3 .2 -1");
  const Probe probe(scene);
  const Light& sun = probe.world().lights[0];
  const EmissionRequest request{.aim = kAim};
  expect_agreement("aimed directional", &sun, probe.world(), request);
  // Far from the box nothing arrives, and photons start outside of the scene.
  const PhotonSource source(probe.world(), sun, request);
  EXPECT_EQ(by_photons(source, {Vec3(2.8f, -2.8f, 2), Vec3(.1f, 0, 0), Vec3(0, .1f, 0)}, 4096).mean,
            0);
  for (int i = 0; i < 100; ++i) {
    sampling::Sampler s(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const EmittedPhoton photon = source.emit(u, s.next_2d());
    EXPECT_GT(length(photon.origin), 3 * std::sqrt(3.0f));
  }
}

// acceptance: S14
TEST(PhotonEmission, SunPhotonsInTheBoxMatchItsIrradiance) {
  // The box is in the light's space, which is turned by a quarter and moved.
  const std::string box = ", \"photon_bbox_min\" -.5 -1.6 -.2, \"photon_bbox_max\" .7 -.3 .2";
  const std::string turned = "transform 0 -1 0 0  1 0 0 0  0 0 1 0  0 -.8 0 1";
  for (const bool automatic : {true, false})
    for (const bool aimed : {true, false}) {
      SceneText scene = stage();
      scene.light(
          "sun",
          fmt::format("\"mia_physicalsun\" ( \"rgb_unit_conversion\" 1 1 1, "
                      "\"automatic_photon_energy\" {}{} ) direction .3 .2 -1 {}",
                      automatic ? "on" : "off", aimed ? box : "", automatic ? "energy 3 2 1" : ""),
          turned);
      const Probe probe(scene);
      const Light& sun = probe.world().lights[0];
      EXPECT_EQ(sun.photons.emission.aim.has_value(), aimed);
      const std::string name = fmt::format("sun, aimed {}, automatic {}", aimed, automatic);
      expect_agreement(name, &sun, probe.world(), sun.photons.emission);
      if (!aimed) continue;
      const PhotonSource source(probe.world(), sun, sun.photons.emission);
      const Vec3 corner(2.8f, -2.8f, 2);
      EXPECT_EQ(by_photons(source, {corner, Vec3(.1f, 0, 0), Vec3(0, .1f, 0)}, 4096).mean, 0);
    }
  // Without it photons carry the energy of the light.
  SceneText scene = stage();
  scene.light("sun", "\"mia_physicalsun\" ( ) direction 0 0 -1 energy 7 7 7");
  const Probe probe(scene);
  ASSERT_TRUE(probe.world().lights[0].photons.emission.energy);
  EXPECT_EQ(*probe.world().lights[0].photons.emission.energy, Rgb(7));
}

// acceptance: S14
TEST(PhotonEmission, SunPhotonsPassOnlyThroughTheirBox) {
  // A window of 2 x 1 x .02, turned by 30 degrees about z in the light's space.
  const float c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  SceneText scene = stage();
  scene.light("sun",
              "\"mia_physicalsun\" ( \"automatic_photon_energy\" on, \"samples\" 0, "
              "\"photon_bbox_min\" -1 -.01 .5, \"photon_bbox_max\" 1 .01 1.5 ) "
              "direction .3 .6 -.5 ",
              fmt::format("transform {} {} 0 0  {} {} 0 0  0 0 1 0  0 0 0 1", c, s, -s, c));
  const Probe probe(scene);
  const Light& sun = probe.world().lights[0];
  const PhotonSource source(probe.world(), sun, sun.photons.emission);
  // Shares of the halves of the window, which even places on its silhouette make equal.
  int left = 0, low = 0;
  constexpr int kCount = 4096;
  const Vec3 along = transform_vector(Vec3(1, 0, 0), sun.to_world),
             across = transform_vector(Vec3(0, 1, 0), sun.to_world);
  const Vec3 centre = transform_point(Vec3(0, 0, 1), sun.to_world);
  for (int i = 0; i < kCount; ++i) {
    sampling::Sampler sampler(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = sampler.next_2d();
    const EmittedPhoton photon = source.emit(u, sampler.next_2d());
    // Where the ray is nearest to the middle plane of the window.
    const float t = dot(centre - photon.origin, across) / dot(photon.direction, across);
    const Vec3 place = photon.origin + photon.direction * t - centre;
    // By the window's thickness the slanted ray is that far off at most.
    const float slip = .01f / std::abs(dot(photon.direction, across));
    EXPECT_LT(std::abs(dot(place, along)), 1 + slip);
    EXPECT_LT(std::abs(place.z), .5f + slip);
    left += dot(place, along) < 0;
    low += place.z < 0;
  }
  const double error = .5 / std::sqrt(kCount);
  EXPECT_NEAR(double(left) / kCount, .5, 4 * error);
  EXPECT_NEAR(double(low) / kCount, .5, 4 * error);
  // Power over all is what flows through the silhouette.
  const Vec3 d = sun.direction;
  const float area =
      2 * 1 * std::abs(dot(d, across)) + .02f * std::abs(dot(d, along)) + .04f * std::abs(d.z);
  ShadingPoint point;
  point.world = &probe.world();
  const auto light = sample_light(sun, point, Vec2(.5f));
  ASSERT_TRUE(light);
  // The side areas: 2 x 1 faces `across`, .02 x 1 `along`, 2 x .02 up.
  EXPECT_NEAR(source.estimate_flux(64).y, light->irradiance.y * area, 1e-3f * light->irradiance.y);
}

// acceptance: L7
TEST(PhotonEmission, EnergyReplacesTheFlux) {
  SceneText scene = stage();
  scene
      .light("spot",
             "\"physical_light\" ( \"color\" 9 5 5, \"cone\" .95 ) origin 0 0 2 "
             "direction .1 0 -1 spread .85")
      .light("lamp", "\"physical_light\" ( \"color\" 3 2 1 ) origin 0 0 2");
  const Probe probe(scene);
  // Only the shape of the shader's light stays.
  const PhotonSource spot(probe.world(), probe.world().lights[0], {.energy = Rgb(7, 8, 9)});
  Rgb sum(0);
  constexpr int kCount = 4096;
  for (int i = 0; i < kCount; ++i) {
    sampling::Sampler s(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    sum += spot.power(spot.emit(u, s.next_2d()), 1.7f) / kCount;
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], kPi * Rgb(7, 8, 9)[k], 1e-3f * sum[k]);
  // A physical light whose energy is its colour is as without.
  const Light& lamp = probe.world().lights[1];
  const PhotonSource same(probe.world(), lamp, {.energy = Rgb(3, 2, 1)}),
      plain(probe.world(), lamp);
  const EmittedPhoton photon = same.emit(Vec2(.3f, .4f), Vec2(.7f, .2f));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(same.power(photon, 2)[k], plain.power(photon, 2)[k], 1e-4f);
}

}  // namespace photon_emission_test
}  // namespace oriel::testing
