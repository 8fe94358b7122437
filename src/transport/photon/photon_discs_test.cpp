// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_discs.h"

#include <gtest/gtest.h>

#include "sampling/sampler.h"

namespace oriel {
namespace photon_discs_test {

const Vec3 kUp(0, 0, 1);
constexpr float kHalf = 2;  ///< of the length of the line

/// Photons on a line along x, of power 1 per length, one in each of equal parts.
std::vector<Photon> line() {
  constexpr std::uint32_t kCount = 8000;
  std::vector<Photon> photons(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    sampling::Sampler sampler(static_cast<int>(i), 0, 0);
    const float place = (static_cast<float>(i) + sampler.next_1d()) / kCount;
    photons[i].position = Vec3(kHalf * (2 * place - 1), 0, 0);
    photons[i].power = Rgb(2 * kHalf / kCount);
  }
  return photons;
}

/// Light per length on both sides of the middle of the line, up to a distance.
template <class Map>
double light_beside(const Map& map, const PhotonLookup& lookup, double up_to) {
  constexpr int kAlong = 100, kAcross = 4000;
  double sum = 0;
  for (int i = 0; i < kAlong; ++i)
    for (int k = 0; k < kAcross; ++k) {
      const double x = kHalf * .5 * (2 * (i + .5) / kAlong - 1);
      const double y = up_to * (2 * (k + .5) / kAcross - 1);
      sum += map.irradiance(Vec3(float(x), float(y), 0), kUp, lookup).y;
    }
  return sum / (kAlong * double(kAcross)) * 2 * up_to;
}

TEST(PhotonDiscs, KeepTheLightOfALine) {
  constexpr int kCount = 16;
  constexpr float kRadius = .2f;
  const PhotonDiscs discs(line(), 0, kCount, kRadius);
  const PhotonLookup lookup{.count = kCount, .radius = kRadius};
  EXPECT_NEAR(light_beside(discs, lookup, kRadius), 1, .02);
  // At a distance d of a line of n photons per length, the disc that reaches the next photon after
  // k has the squared radius d^2 + ((k + 1) / 2n)^2. The integral of k / (pi radius^2) is
  // 2n k / (k + 1).
  const PhotonMap map(line());
  EXPECT_NEAR(light_beside(map, lookup, kRadius), 2. * kCount / (kCount + 1), .04);
}

TEST(PhotonDiscs, KeepTheLightOfAClusterAndOfPhotonsApart) {
  // A cluster has discs of the smallest size, and a lone photon one of the largest.
  std::vector<Photon> photons(101);
  for (std::size_t i = 0; i < 100; ++i) {
    sampling::Sampler sampler(static_cast<int>(i), 0, 0);
    const Vec2 u = sampler.next_2d();
    photons[i].position = Vec3(.001f * u.x, .001f * u.y, 0);
    photons[i].power = Rgb(.01f);
  }
  photons[100].position = Vec3(5, 0, 0);
  photons[100].power = Rgb(1);
  constexpr float kRadius = .32f;
  const PhotonDiscs discs(photons, 0, 10, kRadius);
  const auto at = [&](float x) { return discs.irradiance(Vec3(x, 0, 0), kUp, {}).y; };
  const float of_cluster = 1 / (kPi * sqr(kRadius / 32));
  EXPECT_NEAR(at(.0005f), of_cluster, 1e-4f * of_cluster);
  EXPECT_EQ(at(.012f), 0);
  const float of_one = 1 / (kPi * sqr(kRadius));
  EXPECT_NEAR(at(5 + .95f * kRadius), of_one, 1e-4f * of_one);
  EXPECT_EQ(at(5 + 1.05f * kRadius), 0);
}

TEST(PhotonDiscs, LayersAndFiltersAreThoseOfTheLookup) {
  std::vector<Photon> photons(1);
  photons[0].power = Rgb(1);
  photons[0].layer = 1;
  const PhotonDiscs discs(photons, 0, 10, 1);
  PhotonLookup lookup{.radius = 77, .scale = Rgb(2)};
  Rgb layers[3] = {Rgb(0), Rgb(0), Rgb(0)};
  int found = 0;
  EXPECT_NEAR(discs.irradiance(Vec3(.5f, 0, 0), kUp, lookup, layers, 2, &found).y, 2 / kPi, 1e-5);
  EXPECT_NEAR(layers[1].y, 2 / kPi, 1e-5);
  EXPECT_EQ(layers[0].y + layers[2].y, 0);
  EXPECT_EQ(found, 1);
  // A cone of height 3 / pi whose foot is the disc.
  lookup.filter = scene::PhotonOptions::Filter::Cone;
  lookup.filter_constant = 1;
  EXPECT_NEAR(discs.irradiance(Vec3(.5f, 0, 0), kUp, lookup).y, 2 * 1.5f / kPi, 1e-4);
}

}  // namespace photon_discs_test
}  // namespace oriel
