// SPDX-License-Identifier: Apache-2.0
// Indirect light of portals: photons, and the sky as a bounce.
#include "support/portal_scenes.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace portal_photons_test {

/// Flux on a card of the floor by first hits, and by direct light.
void expect_photons_agree(const char* environment, const std::string& parameters) {
  SceneText scene = room(environment, 1);
  const Probe probe = probe_of(add_window(scene, 1, parameters));
  const World& world = probe.world();
  const PhotonSource source(world, world.lights[0]);
  const Vec3 lo(.5f, -1.5f, 0), hi(3.5f, 1.5f, 0);
  constexpr int kPhotons = 1 << 19;
  double flux = 0, square = 0;
  for (int i = 0; i < kPhotons; ++i) {
    sampling::Sampler s(3, 4, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const EmittedPhoton photon = source.emit(u, s.next_2d());
    if (!(photon.direction.z < 0)) continue;
    const float t = -photon.origin.z / photon.direction.z;
    const Vec3 p = photon.origin + photon.direction * t;
    if (p.x < lo.x || p.x > hi.x || p.y < lo.y || p.y > hi.y) continue;
    const double power = double(source.power(photon, t).y);
    flux += power / kPhotons;
    square += power * power / kPhotons;
  }
  const double error = std::sqrt((square - flux * flux) / kPhotons);
  double direct = 0;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      direct += double(by_quadrature(world,
                                     Vec3(lerp(lo.x, hi.x, (float(i) + .5f) / kSteps),
                                          lerp(lo.y, hi.y, (float(j) + .5f) / kSteps), 0),
                                     kUp, RayKind::FinalGather, 96)
                           .y *
                       kPi * (hi.x - lo.x) * (hi.y - lo.y)) /
                (kSteps * kSteps);
  EXPECT_LT(error, .006 * direct) << "too noisy";
  EXPECT_NEAR(flux, direct, .02 * direct);
  EXPECT_NEAR(flux, direct, 4 * error + .002 * direct);
  figure(std::string("photons of a portal, ") + environment, direct, flux, error);
}

// acceptance: L7
TEST(Portal, PhotonsAgreeWithItsDirectLight) {
  expect_photons_agree(kSky, "");
  expect_photons_agree(kLamps, "\"emit_direct_photons\" on, \"cutoff_threshold\" 0");
}

// acceptance: L7
TEST(Portal, DirectPhotonsReplaceItsDirectLight) {
  const auto trace = [](const std::string& parameters, bool sky) {
    SceneText scene = room(kSky, .001f);
    const Probe probe = probe_of(add_window(scene, 1, parameters));
    PhotonSettings settings;
    settings.each.global.emit = sky ? 0 : 200000;
    settings.environment.global.emit = sky ? 200000 : 0;
    RayCounts counts;
    const PhotonMaps maps = trace_photons(probe.world(), settings, counts);
    double floor = 0;
    for (const Photon& photon : maps.global.photons())
      if (photon.position.z < 1e-3f && photon.position.x > 0 && photon.position.x < 4 &&
          std::abs(photon.position.y) < 1.5f)
        floor += double(photon.power.y);
    return floor;
  };
  SceneText scene = room(kSky, 1);
  const Probe probe = probe_of(add_window(scene));
  double direct = 0;
  constexpr int kX = 16, kY = 12;
  for (int i = 0; i < kX; ++i)
    for (int j = 0; j < kY; ++j)
      direct +=
          double(by_quadrature(probe.world(),
                               Vec3(4 * (float(i) + .5f) / kX, 3 * (float(j) + .5f) / kY - 1.5f, 0),
                               kUp, RayKind::FinalGather, 96)
                     .y *
                 kPi * 12) /
          (kX * kY);
  EXPECT_NEAR(trace("\"emit_direct_photons\" on", false), direct, .02 * direct);
  EXPECT_LT(trace("", false), .01 * direct);
  // Photons of the sky itself do not come through as well.
  EXPECT_EQ(trace("", true), 0);
  EXPECT_EQ(probe_of(add_window(scene = room(kSky, 1), 1, "\"emit_direct_photons\" on"))
                .direct_only()
                .onto(Vec3(2, .3f, 0), kUp, 20, 64, .1f)
                .mean,
            Rgb(0));
}

// acceptance: L8
TEST(Portal, OneBounceOfGatheringHasABounceOfTheSky) {
  // The front wall sees no sky itself.
  const auto wall = [](bool portal) {
    SceneText scene = room(kSky, .5f);
    if (portal) add_window(scene);
    const Probe probe = probe_of(scene);
    const PathSettings settings{.diffuse_bounces = 1};
    Rgb sum(0);
    RayCounts counts;
    constexpr int kSamples = 4096;
    for (int i = 0; i < kSamples; ++i) {
      sampling::Sampler sampler(5, 6, static_cast<std::uint32_t>(i));
      const Camera::Ray eye{Vec3(.5f, 0, 2.6f), Vec3(-1, 0, 0), 1, 0, 0};
      sum += trace_path(probe.world(), eye, Vec2(0), settings, sampler, counts).radiance /
             static_cast<float>(kSamples);
    }
    return sum;
  };
  EXPECT_EQ(wall(false), Rgb(0));
  EXPECT_GT(wall(true).y, .01f);
}

}  // namespace portal_photons_test
}  // namespace oriel::testing
