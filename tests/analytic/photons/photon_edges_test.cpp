// SPDX-License-Identifier: Apache-2.0
// Estimates of photons keep the light of surfaces with edges.
#include "transport/photon/photon_edges.h"
#include "support/probe.h"

namespace oriel::testing {
namespace photon_edges_test {

constexpr PhotonLookup kLookup{.count = 4096, .radius = .3f};
constexpr std::uint32_t kPhotons = 20000;

/// Photons all over the square of side 2 at z = 0, of irradiance 1.
std::vector<Photon> even_photons() {
  std::vector<Photon> photons(kPhotons);
  for (std::uint32_t i = 0; i < kPhotons; ++i) {
    const Vec2 u = sampling::Sampler(static_cast<int>(i), 0, 0).next_2d();
    photons[i].position = Vec3(2 * u.x - 1, 2 * u.y - 1, 0);
    photons[i].power = Rgb(4.0f / kPhotons);
  }
  return photons;
}

/// Mean of the estimates over the square.
double mean_estimate(const PhotonMap& map) {
  constexpr int kN = 40;
  double sum = 0;
  for (int i = 0; i < kN * kN; ++i) {
    const Vec3 p((static_cast<float>(i % kN) + .5f) * 2 / kN - 1,
                 (static_cast<float>(i / kN) + .5f) * 2 / kN - 1, 0);
    sum += static_cast<double>(map.irradiance(p, kUp, kLookup).x);
  }
  return sum / (kN * kN);
}

/// Mean share of a disc of radius r around points of a square of side a that is in the square: the
/// mean area of overlap of the square with itself shifted within the disc.
double mean_share(double r, double a) {
  double sum = 0, all = 0;
  constexpr int kN = 400;
  for (int i = 0; i < kN * kN; ++i) {
    const double x = (i % kN + .5) * 2 / kN - 1, y = (i / kN + .5) * 2 / kN - 1;
    if (x * x + y * y > 1) continue;
    sum += (1 - std::abs(x) * r / a) * (1 - std::abs(y) * r / a);
    all += 1;
  }
  return sum / all;
}

SceneText floor_alone() {
  SceneText scene;
  return scene.lambert("grey", .5f).square("grey", Vec3(0), 1, kUp);
}

// acceptance: H3
TEST(PhotonEdges, AnOpenSquareKeepsItsLight) {
  const Probe probe(floor_alone());
  PhotonMap map(even_photons());
  EXPECT_NEAR(mean_estimate(map), mean_share(.3, 2), .01) << "what is lost without";
  keep_light_at_edges(map, probe.world(), kLookup);
  EXPECT_NEAR(mean_estimate(map), 1, .01);
  EXPECT_NEAR(map.irradiance(Vec3(0), kUp, kLookup).x, 1, .05);
}

TEST(PhotonEdges, WallsHideTheFloorBehindThem) {
  // The floor goes on behind a wall at x = 0; photons and estimates are on this side of it.
  SceneText scene;
  scene.lambert("grey", .5f)
      .square("grey", Vec3(0), 5, kUp)
      .box("grey", Vec3(0, -5, 0), Vec3(.05f, 5, 2));
  const Probe probe(scene);
  std::vector<Photon> photons = even_photons();
  std::erase_if(photons,
                [](const Photon& p) { return p.position.x > 0 || std::abs(p.position.y) > .99f; });
  PhotonMap map(photons);
  const auto near_wall = [&] {
    double sum = 0;
    for (int i = 0; i < 30; ++i)
      sum += static_cast<double>(
          map.irradiance(Vec3(-.01f * (static_cast<float>(i) + .5f), 0, 0), kUp, kLookup).x);
    return sum / 30;
  };
  const double before = near_wall();
  keep_light_at_edges(map, probe.world(), kLookup);
  EXPECT_LT(before, .85);
  EXPECT_NEAR(near_wall(), 1, .06);
}

TEST(PhotonEdges, LightDoesNotLeakThroughThinWalls) {
  SceneText scene;
  scene.lambert("grey", .5f)
      .square("grey", Vec3(0), 5, kUp)
      .polygon("grey", {Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(0, 5, 2), Vec3(0, -5, 2)});
  const Probe probe(scene);
  std::vector<Photon> photons = even_photons();
  std::erase_if(photons, [](const Photon& p) { return p.position.x > 0; });
  PhotonMap map(photons);
  PhotonLookup lookup = kLookup;
  lookup.walls_of = &probe.world();
  EXPECT_GT(map.irradiance(Vec3(.05f, 0, 0), kUp, lookup).x, .3f) << "without marks";
  keep_light_at_edges(map, probe.world(), lookup);
  EXPECT_EQ(map.irradiance(Vec3(.05f, 0, 0), kUp, lookup).x, 0);
  EXPECT_GT(map.irradiance(Vec3(-.05f, 0, 0), kUp, lookup).x, .7f);
}

TEST(PhotonEdges, GlassHidesNothing) {
  SceneText scene;
  scene.lambert("grey", .5f)
      .material("pane", "\"transparency\" 1, \"thin_walled\" on, \"diffuse_weight\" 0")
      .square("grey", Vec3(0), 5, kUp)
      .polygon("pane", {Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(0, 5, 2), Vec3(0, -5, 2)});
  const Probe probe(scene);
  PhotonMap map(even_photons());
  const float before = map.irradiance(Vec3(.1f, 0, 0), kUp, kLookup).x;
  keep_light_at_edges(map, probe.world(), kLookup);
  EXPECT_NEAR(map.irradiance(Vec3(.1f, 0, 0), kUp, kLookup).x, before, 1e-5f);
}

}  // namespace photon_edges_test
}  // namespace oriel::testing
