// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "sampling/sampler.h"

namespace oriel {
namespace photon_map_test {

using Filter = scene::PhotonOptions::Filter;
const Vec3 kUp(0, 0, 1);

/// n photons on [-1, 1]^2 at z = 0, independent and even, that bring irradiance (1, 2, 3).
std::vector<Photon> plane(std::uint32_t n) {
  std::vector<Photon> photons(n);
  const float power = 4 / static_cast<float>(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    // A pixel of its own for each, so that they are not stratified.
    sampling::Sampler sampler(static_cast<int>(i), 0, 0);
    const Vec2 u = sampler.next_2d();
    photons[i].position = Vec3(2 * u.x - 1, 2 * u.y - 1, 0);
    photons[i].power = Rgb(power, 2 * power, 3 * power);
  }
  return photons;
}

/// Mean and standard error of estimates on a grid of points whose discs do not overlap.
struct Mean {
  double mean = 0, error = 0;
};
Mean mean_estimate(const PhotonMap& map, const PhotonLookup& lookup) {
  std::vector<double> values;
  for (int y = -7; y <= 7; ++y)
    for (int x = -7; x <= 7; ++x)
      values.push_back(map.irradiance(Vec3(x * .12f, y * .12f, 0), kUp, lookup).y / 2);
  Mean m;
  for (const double v : values) m.mean += v / double(values.size());
  for (const double v : values) m.error += (v - m.mean) * (v - m.mean);
  m.error = std::sqrt(m.error / double(values.size() - 1) / double(values.size()));
  return m;
}

// acceptance: H3
TEST(PhotonMap, EstimatesAUniformPlaneByCountAndByRadius) {
  const PhotonMap map(plane(200000));
  for (const Filter filter : {Filter::Box, Filter::Cone, Filter::Gauss})
    for (const auto& [count, radius] : {std::pair(100, 1.0f), {20, 1.0f}, {4096, .05f}}) {
      const Mean m = mean_estimate(map, {.count = count, .radius = radius, .filter = filter});
      EXPECT_NEAR(m.mean, 1, 4 * m.error) << int(filter) << ' ' << count;
      EXPECT_LT(m.error, .025) << int(filter) << ' ' << count;
    }
}

TEST(PhotonMap, ExtentIsThatOfMostPhotons) {
  // Photons all over a box of 3 x 4 x 12, and one in thirty far away.
  std::vector<Photon> photons(3000);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    sampling::Sampler random(static_cast<int>(i), 0, 0);
    const Vec2 a = random.next_2d(), b = random.next_2d();
    photons[i].position = Vec3(7 + 3 * a.x, 4 * a.y, 12 * b.x);
    if (i % 30 == 0) photons[i].position *= 1000;
  }
  EXPECT_NEAR(PhotonMap(photons).extent(), 13, .4);
  EXPECT_EQ(PhotonMap().extent(), 0);
}

TEST(PhotonMap, CoarseEstimatesKeepTheMean) {
  PhotonMap map(plane(20000));
  // By the radius alone, with few photons in each disc, and by the count.
  for (const auto& [count, radius] : {std::pair(1000, .03f), {10, .1f}}) {
    const PhotonLookup lookup{.count = count, .radius = radius};
    map.estimate_at_places(lookup);
    double mean = 0;
    for (int y = -50; y <= 50; ++y)
      for (int x = -50; x <= 50; ++x)
        mean += map.coarse_irradiance(Vec3(x * .018f, y * .018f, 0), kUp, lookup).y / 2;
    mean /= 101 * 101;
    // Half of the 14 photons in a disc count, and about 1100 discs are independent: 3 standard
    // errors are .034. By photons that count themselves it would be too bright, by all others too
    // dark.
    EXPECT_NEAR(mean, 1, .034) << count;
  }
  EXPECT_EQ(map.coarse_irradiance(Vec3(0, 0, 1), kUp, {.count = 10, .radius = .03f}), Rgb(0));
}

TEST(PhotonMap, CoarseEstimatesAreThoseOfTheirSide) {
  // Irradiance 2 from above on a floor, 1 from below at a ceiling close to it, and on two walls.
  std::vector<Photon> photons;
  const auto add = [&](std::vector<Photon> plane, float power, const auto& place) {
    for (Photon& photon : plane) {
      photon.power *= power;
      place(photon);
      photons.push_back(photon);
    }
  };
  add(plane(20000), 1, [](Photon&) {});
  add(plane(20000), .5f, [](Photon& p) {
    p.position.z = -.02f;
    p.normal = -kUp;
  });
  add(plane(20000), .25f, [](Photon& p) {
    p.position = Vec3(3, p.position.x, p.position.y);
    p.normal = Vec3(-1, 0, 0);
  });
  PhotonMap map(std::move(photons));
  const PhotonLookup lookup{.count = 200, .radius = .1f};
  map.estimate_at_places(lookup);
  const auto mean = [&](const Vec3& normal, const auto& place) {
    double sum = 0;
    for (int i = -20; i <= 20; ++i)
      for (int k = -20; k <= 20; ++k)
        sum += map.coarse_irradiance(place(i * .04f, k * .04f), normal, lookup).y / (41 * 41);
    return sum;
  };
  const auto floor = [](float x, float y) { return Vec3(x, y, 0); };
  EXPECT_NEAR(mean(kUp, floor), 2, .1);
  EXPECT_NEAR(mean(normalize(Vec3(.5f, 0, 1)), floor), 2, .1) << "slanted by 27 degrees";
  EXPECT_NEAR(mean(-kUp, [](float x, float y) { return Vec3(x, y, -.02f); }), 1, .05);
  const auto wall = [](float x, float y) { return Vec3(3, x, y); };
  EXPECT_NEAR(mean(Vec3(-1, 0, 0), wall), .5, .025);
  EXPECT_EQ(mean(Vec3(1, 0, 0), wall), 0);
  EXPECT_EQ(map.coarse_irradiance(Vec3(0, 0, 9), kUp, lookup), Rgb(0)) << "outside of the table";
}

TEST(PlaceTable, AnswersAreThoseOfTheCell) {
  // More cells than the table has room for. The search returns the coordinates of its point, and
  // nothing for directions that point down.
  const geom::Box3 box(Vec3(-2, -1, 5), Vec3(2, 3, 8));
  const auto search = [](const Vec3& centre, const Vec3& facing) -> std::optional<std::uint32_t> {
    if (facing.z < 0) return std::nullopt;
    const auto cell = [](float x) { return static_cast<std::uint32_t>((x + 2) * 25); };
    return cell(centre.x) * 16384u + cell(centre.y) * 128u + cell(centre.z) % 128u;
  };
  for (const std::size_t places : {std::size_t(1000), std::size_t(1) << 22}) {
    const PlaceTable table(box, .01f, places);
    std::atomic<int> wrong = 0, found = 0;
    for (int round = 0; round < 2; ++round)
      parallel_for(64, [&](std::size_t part) {
        for (int i = 0; i < 40000; ++i) {
          sampling::Sampler random(static_cast<int>(part), i, 0);
          const Vec2 a = random.next_2d(), b = random.next_2d();
          const Vec3 position(-2 + 4 * a.x, -1 + 4 * a.y, 5 + 3 * b.x);
          const Vec3 normal = b.y < .5f ? Vec3(0, 0, -1) : normalize(Vec3(b.y, a.y, 1));
          const auto place = table.find(position, normal, search);
          // The centre is at most half a cell of the search away along each axis.
          const auto expected = search(position, normal);
          wrong += place.has_value() != expected.has_value();
          found += place.has_value();
          if (place && expected)
            for (const std::uint32_t unit : {16384u, 128u, 1u})
              wrong += std::abs(int(*place / unit % 128) - int(*expected / unit % 128)) > 1;
        }
      });
    EXPECT_EQ(wrong, 0) << places;
    EXPECT_NEAR(found, 64 * 40000, 64 * 400) << places;
    EXPECT_FALSE(table.find(Vec3(2.1f, 0, 6), kUp, search)) << "outside";
  }
}

TEST(PhotonMap, FiltersDifferInBlurOnly) {
  const auto estimate = [](Filter filter, float constant, float x) {
    Photon photon;
    photon.power = Rgb(kPi);
    return PhotonMap({photon})
        .irradiance(Vec3(x, 0, 0), kUp,
                    {.count = 10, .radius = 1, .filter = filter, .filter_constant = constant})
        .x;
  };
  EXPECT_FLOAT_EQ(estimate(Filter::Box, 1, .9f), 1);
  // A cone of constant 1 has three times the mean at its centre.
  EXPECT_NEAR(estimate(Filter::Cone, 1, 0), 3, 1e-5f);
  EXPECT_NEAR(estimate(Filter::Cone, 1, .5f), 1.5f, 1e-5f);
  EXPECT_NEAR(estimate(Filter::Cone, 2, 0), 1.5f, 1e-5f);
  EXPECT_NEAR(estimate(Filter::Gauss, 1, 0), 1 / .57859f, 1e-3f);
  EXPECT_EQ(estimate(Filter::Box, 1, 1.01f), 0);
}

TEST(PhotonMap, FindsTheSamePhotonsAsASearchOfAll) {
  std::vector<Photon> photons(3000);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    sampling::Sampler s(static_cast<int>(i), 1, 0);
    const Vec2 a = s.next_2d(), b = s.next_2d();
    // Coarse steps make many coordinates equal.
    photons[i].position = Vec3(std::round(a.x * 20), std::round(a.y * 20), b.x * 4) / 20;
    photons[i].power = Rgb(b.y);
    photons[i].normal = i % 3 == 0 ? Vec3(1, 0, 0) : kUp;
  }
  const PhotonMap map(photons);
  const float kRadius = .2f;
  for (int i = 0; i < 200; ++i) {
    sampling::Sampler s(i, 2, 0);
    const Vec2 a = s.next_2d();
    const Vec3 p(a.x, a.y, .1f);
    double sum = 0;
    for (const Photon& photon : photons) {
      Vec3 d = photon.position - p;
      d.z *= PhotonMap::kFlattening;
      if (photon.normal.z > .5f && length(d) < kRadius) sum += photon.power.x;
    }
    const Rgb e = map.irradiance(p, kUp, {.count = 4096, .radius = kRadius});
    EXPECT_NEAR(e.x, sum / (kPi * kRadius * kRadius), 1e-4 * sum / .12 + 1e-6);
  }
}

TEST(PhotonMap, IsIndependentOfThePhotonOrder) {
  std::vector<Photon> photons = plane(5000);
  const PhotonMap map(photons, .01f);
  std::reverse(photons.begin(), photons.end());
  std::swap(photons[100], photons[4000]);
  const PhotonMap other(photons, .01f);
  ASSERT_EQ(map.size(), other.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_EQ(map.photons()[i].position, other.photons()[i].position);
    EXPECT_EQ(map.photons()[i].power, other.photons()[i].power);
  }
}

TEST(PhotonMap, SurfacesThatFaceElsewhereDoNotCount) {
  std::vector<Photon> photons = plane(1000);
  for (Photon& p : photons) p.normal = -kUp;
  const PhotonMap below(photons);
  const PhotonLookup lookup{.count = 2000, .radius = .5f};
  EXPECT_EQ(below.irradiance(Vec3(0), kUp, lookup), Rgb(0));
  EXPECT_GT(below.irradiance(Vec3(0), -kUp, lookup).x, .5f);
  // The wall in a corner.
  EXPECT_EQ(below.irradiance(Vec3(0), Vec3(1, 0, 0), lookup), Rgb(0));
  // A plane in parallel, farther than a third of the radius.
  EXPECT_EQ(below.irradiance(Vec3(0, 0, .2f), -kUp, lookup), Rgb(0));
}

// acceptance: H3
TEST(PhotonMap, MergingPreservesPower) {
  const std::vector<Photon> photons = plane(20000);
  const PhotonMap all(photons), merged(photons, .02f);
  const auto power = [](const PhotonMap& map) {
    double sum = 0;
    for (const Photon& p : map.photons()) sum += p.power.z;
    return sum;
  };
  EXPECT_NEAR(power(merged), power(all), 1e-6 * power(all));
  EXPECT_LT(merged.size(), 8000u);
  const PhotonLookup lookup{.count = 4096, .radius = .3f};
  EXPECT_NEAR(merged.irradiance(Vec3(0), kUp, lookup).x, all.irradiance(Vec3(0), kUp, lookup).x,
              .02f);
}

TEST(PhotonMap, MergedPhotonsLieApart) {
  Photon a, b, c;
  b.position = Vec3(.01f, 0, 0);
  b.power = a.power = Rgb(1);
  c.position = Vec3(.02f, 0, 0);
  c.normal = Vec3(1, 0, 0);
  const PhotonMap map({a, b, c}, .05f);
  ASSERT_EQ(map.size(), 2u);
  const Photon& sum = map.photons()[0].power.x > 0 ? map.photons()[0] : map.photons()[1];
  EXPECT_EQ(sum.power, Rgb(2));
  EXPECT_NEAR(sum.position.x, .005f, 1e-7f);
}

// Photons are sorted into cells as wide as the distance; neighbours may lie in any of those around.
TEST(PhotonMap, MergesAcrossCellsInAllDirections) {
  constexpr float kDistance = .5f;
  for (int i = 0; i < 27; ++i) {
    const Vec3 step(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                    static_cast<float>(i / 9 - 1));
    Photon a, b;
    a.position = Vec3(kDistance / 2);
    b.position = a.position + step * (.55f * kDistance);  // at most .55 sqrt(3) of the distance
    a.power = b.power = Rgb(1);
    const PhotonMap map({a, b}, kDistance);
    ASSERT_EQ(map.size(), 1u) << i;
    EXPECT_EQ(map.photons()[0].power, Rgb(2));
  }
}

TEST(PhotonMap, ScaleAndDefaultsFollowTheOptions) {
  const geom::Box3 room(Vec3(0), Vec3(3, 4, 12));
  scene::PhotonOptions options;
  options.scale = Rgba(2, 3, 4, 1);
  const PhotonLookup global = photon_lookup(options, room, PhotonKind::Global);
  EXPECT_FLOAT_EQ(global.radius, 1.3f);
  EXPECT_FLOAT_EQ(photon_lookup(options, room, PhotonKind::Caustic).radius, .065f);
  options.radius = .5f;
  const PhotonLookup given = photon_lookup(options, room, PhotonKind::Caustic);
  EXPECT_FLOAT_EQ(given.radius, .5f);
  Photon photon;
  photon.power = Rgb(kPi * .25f);
  EXPECT_NEAR((PhotonMap({photon}).irradiance(Vec3(0), kUp, given) - Rgb(2, 3, 4)).length(), 0,
              1e-5f);
}

TEST(PhotonMap, TakesAnyPhotons) {
  EXPECT_EQ(PhotonMap().irradiance(Vec3(0), kUp, {}), Rgb(0));
  Photon bad, good;
  bad.position.x = NAN;
  good.power = Rgb(1);
  EXPECT_EQ(PhotonMap({bad, good, bad}).size(), 1u);
  // All in one place.
  const PhotonMap one(std::vector<Photon>(1000, good));
  EXPECT_TRUE(is_finite(one.irradiance(Vec3(0), kUp, {.count = 10, .radius = 1})));
  EXPECT_EQ(one.irradiance(Vec3(0), kUp, {.count = 10, .radius = -1}), Rgb(0));
  EXPECT_TRUE(is_finite(one.irradiance(Vec3(0), kUp, {.count = -3, .radius = 1})));
}

}  // namespace photon_map_test
}  // namespace oriel
