// SPDX-License-Identifier: Apache-2.0
// Records of final gathering against closed forms: irradiance, gradients, filter, blurred light.
#include "transport/gather/gather_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sampling/sampler.h"

namespace oriel {
namespace gather_record_test {

constexpr float kNothing = std::numeric_limits<float>::infinity();
const Vec3 kUp(0, 0, 1);

struct Seen {
  float radiance, distance;
  Vec3 normal = Vec3(0);
};

/// Rays jittered within their strata, `scene(origin, direction)` answering with Seen.
template <class Scene>
GatherRecord gather(const Vec3& position, const Vec3& normal, int rays, const Scene& scene,
                    const GatherRadii& radii = {}, float turn = 0) {
  const auto hemisphere = GatherHemisphere::for_rays(normal, rays, turn);
  std::vector<GatherSample> samples;
  for (int i = 0; i < hemisphere.count(); ++i) {
    sampling::Sampler sampler(i, 0, 0, 7);
    const Vec3 w = hemisphere.direction(i, sampler.next_2d());
    const Seen seen = scene(position, w);
    samples.push_back({w, Rgb(seen.radiance, 2 * seen.radiance, 0), seen.distance, seen.normal});
  }
  return make_gather_record(position, hemisphere, samples, radii);
}

/// A wall at x = 0 of the given height, endless along y, radiance 1; floor at z = 0, sky black.
Seen wall(const Vec3& o, const Vec3& w, float height) {
  if (w.x >= 0) return {0, kNothing};
  const float t = -o.x / w.x;
  return o.z + t * w.z < height ? Seen{1, t, Vec3(1, 0, 0)} : Seen{0, kNothing};
}
/// Irradiance of a floor point before it: 2D form factor pi / 2 (sin b - sin a) of the angles from
/// the normal.
double wall_irradiance(double x, double height) {
  return 0.5 * M_PI * (1 - x / std::hypot(x, height));
}

/// A square of side 2 and radiance 1 around the z axis at z = 1, facing down.
Seen square(const Vec3& o, const Vec3& w) {
  if (w.z <= 0) return {0, kNothing};
  const float t = (1 - o.z) / w.z;
  const Vec3 p = o + w * t;
  return std::abs(p.x) < 1 && std::abs(p.y) < 1 ? Seen{1, t, kUp} : Seen{0, kNothing};
}
/// Its irradiance on a point of the plane z = 0 with the given normal, by the midpoint rule.
double square_irradiance(const Vec3& at, const Vec3& normal) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) * 2 / kSteps - 1 - double(at.x);
      const double y = (j + 0.5) * 2 / kSteps - 1 - double(at.y);
      const double d2 = x * x + y * y + 1;
      const double facing = x * double(normal.x) + y * double(normal.y) + double(normal.z);
      sum += std::max(0.0, facing) / (d2 * d2);
    }
  return sum * 4 / (double(kSteps) * kSteps);
}

TEST(GatherRecord, UniformRadianceGivesPiAndNoGradients) {
  for (const int rays : {1, 7, 100, 1000}) {
    const Vec3 normal = normalize(Vec3(1, -2, 0.5f));
    const auto r = gather(Vec3(3), normal, rays, [](const Vec3&, const Vec3&) {
      return Seen{1, 2};
    });
    EXPECT_NEAR(r.irradiance.x, kPi, 1e-5f);
    EXPECT_NEAR(r.irradiance.y, 2 * kPi, 1e-5f);
    EXPECT_EQ(r.irradiance.z, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LT(length(r.by_position[c]), 1e-5f);
      EXPECT_LT(length(r.by_normal[c]), 1e-5f);
    }
    EXPECT_NEAR(r.mean_distance, 2, 1e-4f);
    EXPECT_NEAR(r.min_distance, 2, 1e-5f);
  }
}

TEST(GatherRecord, LinearEnvironmentMatchesItsIntegral) {
  // Integrals over the hemisphere: of cos 1 pi, of z cos 2 pi / 3, of x x 2 pi / 3.
  const Vec3 g(0.5f, -0.2f, 0.3f), normal = normalize(Vec3(0.3f, 0.4f, 1));
  const auto r = gather(
      Vec3(0), normal, 4000,
      [&](const Vec3&, const Vec3& w) {
        return Seen{1 + dot(g, w), kNothing};
      },
      {}, 0.13f);
  const float two_thirds = 2 * kPi / 3;
  EXPECT_NEAR(r.irradiance.x, kPi + two_thirds * dot(g, normal), 1e-3f);
  const Vec3 tangential = (g - normal * dot(g, normal)) * two_thirds;
  EXPECT_LT(length(r.by_normal[0] - tangential), 5e-3f);
  EXPECT_LT(length(r.by_normal[1] - tangential * 2.0f), 1e-2f);
  // Infinitely far light does not move.
  EXPECT_LT(length(r.by_position[0]), 1e-6f);
}

TEST(GatherRecord, GradientsMatchAWallBesideAFloor) {
  for (const float x : {0.3f, 1.0f, 2.0f}) {
    const auto r = gather(
        Vec3(x, 0, 0), kUp, 5000, [](const Vec3& o, const Vec3& w) { return wall(o, w, 1.5f); }, {},
        0.03f);
    const double e = wall_irradiance(x, 1.5);
    const double slope = (wall_irradiance(x + 1e-3, 1.5) - wall_irradiance(x - 1e-3, 1.5)) / 2e-3;
    EXPECT_NEAR(r.irradiance.x, e, 0.02 * e);
    EXPECT_NEAR(r.by_position[0].x, slope, 0.05 * std::abs(slope)) << x;
    EXPECT_NEAR(r.by_position[0].y, 0, 0.05 * std::abs(slope)) << x;
    EXPECT_NEAR(r.by_position[0].z, 0, 1e-6);
    // Light across the floor: -sin over the wall's angles from the normal, times the integral of
    // cos^2 along the wall, pi / 2.
    const double across = -M_PI / 2 * 1.5 / std::hypot(double(x), 1.5);
    EXPECT_NEAR(r.by_normal[0].x, across, 0.03 * std::abs(across)) << x;
  }
}

TEST(GatherRecord, GradientsMatchASquareAbove) {
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.5f, 0.2f, 0), Vec3(1.5f, 0, 0)}) {
    const auto r = gather(at, kUp, 5000, square);
    const auto slope = [&](const Vec3& d) {
      return (square_irradiance(at + d * 1e-2f, kUp) - square_irradiance(at - d * 1e-2f, kUp)) /
             2e-2;
    };
    EXPECT_NEAR(r.irradiance.x, square_irradiance(at, kUp), 0.02);
    EXPECT_NEAR(r.by_position[0].x, slope(Vec3(1, 0, 0)), 0.05) << at.x;
    EXPECT_NEAR(r.by_position[0].y, slope(Vec3(0, 1, 0)), 0.05) << at.x;
    // The square is above all horizons that are this little turned.
    const auto turned = [&](const Vec3& d) {
      return (square_irradiance(at, kUp + d * 1e-2f) - square_irradiance(at, kUp - d * 1e-2f)) /
             2e-2;
    };
    EXPECT_NEAR(r.by_normal[0].x, turned(Vec3(1, 0, 0)), 0.03) << at.x;
    EXPECT_NEAR(r.by_normal[0].y, turned(Vec3(0, 1, 0)), 0.03) << at.x;
  }
}

TEST(GatherRecord, GradientsOfFewRaysAreRightInTheMean) {
  // 400 records of about 100 rays: the mean's standard error is well below the tolerance.
  const double slope = (wall_irradiance(1.001, 1.5) - wall_irradiance(0.999, 1.5)) / 2e-3;
  double sum = 0;
  for (int i = 0; i < 400; ++i)
    sum += double(gather(
                      Vec3(1, 0, 0), kUp, 100,
                      [](const Vec3& o, const Vec3& w) { return wall(o, w, 1.5f); }, {},
                      static_cast<float>(i) / 400)
                      .by_position[0]
                      .x);
  EXPECT_NEAR(sum / 400, slope, 0.1 * std::abs(slope));
}

TEST(GatherRecord, RadiusIsTheHarmonicMeanWithinBounds) {
  const auto room = [](const Vec3&, const Vec3& w) { return Seen{1, w.z > 0.5f ? 4.0f : 2.0f}; };
  // cos > 1/2 holds 3/4 of the cosine-weighted hemisphere: 1 / (3/4 / 4 + 1/4 / 2).
  EXPECT_NEAR(gather(Vec3(0), kUp, 4000, room).radius, 16 / 5.0f, 0.02f);
  EXPECT_EQ(gather(Vec3(0), kUp, 100, room, {4, 5}).radius, 4);
  EXPECT_EQ(gather(Vec3(0), kUp, 100, room, {0.1f, 1.5f}).radius, 1.5f);
  const auto niche = [](const Vec3&, const Vec3& w) { return Seen{1, w.z > .2f ? 100.f : .5f}; };
  EXPECT_FLOAT_EQ(gather(Vec3(0), kUp, 400, niche).radius, 1) << "twice the nearest distance";
  const GatherRadii pixels{1, 10, true};
  EXPECT_FLOAT_EQ(gather(Vec3(0), kUp, 100, room, pixels.in_scene(0.01f)).radius, 0.1f);
}

TEST(GatherRecord, ExtrapolationIsBounded) {
  GatherRecord r;
  r.irradiance = Rgb(1, 2, 0);
  r.by_position = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(5, 0, 0)};
  const Rgb near = extrapolate(r, Vec3(0.25f, 0, 0), kUp), far = extrapolate(r, Vec3(9, 0, 0), kUp);
  EXPECT_FLOAT_EQ(near.x, 1.25f);
  EXPECT_FLOAT_EQ(near.y, 1.75f);
  EXPECT_EQ(far, Rgb(2, 1, 0));
  EXPECT_EQ(extrapolate(r, Vec3(-9, 0, 0), kUp), Rgb(0.5f, 4, 0));
}

TEST(GatherRecord, BrokenRadianceCountsAsBlack) {
  const auto h = GatherHemisphere::for_rays(kUp, 100);
  std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
  for (auto& s : samples) s = {kUp, Rgb(std::nanf("")), std::nanf("")};
  const auto r = make_gather_record(Vec3(0), h, samples, {0.1f, 1});
  EXPECT_EQ(r.irradiance, Rgb(0));
  EXPECT_EQ(r.radius, 0.1f);
}

TEST(GatherRecord, SectorsRunOnceAround) {
  const Vec3 n = normalize(Vec3(1, 2, 3));
  const Frame f(n);
  for (int i = 0; i < 8; ++i) {
    const float phi = static_cast<float>(i) * kPi / 4;
    EXPECT_NEAR(gather_sector(n, f.s * std::cos(phi) + f.t * std::sin(phi) + n * 0.3f),
                static_cast<float>(i), 1e-4f);
  }
}

TEST(GatherRecord, FreeWayEndsAtAWall) {
  const auto r = gather(Vec3(0.4f, 0, 0), kUp, 200,
                        [](const Vec3& o, const Vec3& w) { return wall(o, w, 3); });
  const auto towards = static_cast<std::size_t>(std::lround(gather_sector(kUp, Vec3(-1, 0, 0))));
  EXPECT_NEAR(r.free[towards % 8], 0.4f, 0.06f);
  EXPECT_EQ(r.free[(towards + 4) % 8], kGatherFarthest);
}

// ---- filter

TEST(GatherRecord, FilterRemovesASpeckle) {
  const auto h = GatherHemisphere::for_rays(kUp, 100);
  std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
  for (auto& s : samples) s.radiance = Rgb(1);
  samples[static_cast<std::size_t>(2 * h.sectors)].radiance = Rgb(5000);
  const auto speckled = make_gather_record(Vec3(0), h, samples, {}, 0);
  EXPECT_GT(speckled.irradiance.x, 10 * kPi);
  for (int reach = 1; reach <= 4; ++reach) {
    const auto r = make_gather_record(Vec3(0), h, samples, {}, reach);
    EXPECT_NEAR(r.irradiance.x, kPi, 1e-4f) << reach;
  }
}

TEST(GatherRecord, FilterPreservesAnEdge) {
  auto h = GatherHemisphere::for_rays(kUp, 300);
  std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
  for (int i = 0; i < h.count(); ++i)
    samples[static_cast<std::size_t>(i)].radiance =
        Rgb(i % h.sectors < h.sectors / 2 ? 1.0f : 0.0f);
  const auto before = samples;
  filter_speckles(samples, h.rings, h.sectors, 1);
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_EQ(samples[i].radiance, before[i].radiance) << i;
}

TEST(GatherRecord, FilterDarkensSkewedRadiance) {
  // Exponential radiance of mean 1: medians of 9 tend to ln 2 + a little, of 81 to ln 2.
  const auto h = GatherHemisphere::for_rays(kUp, 4000);
  std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
  sampling::Sampler sampler(1, 2, 3);
  for (auto& s : samples) s.radiance = Rgb(-std::log(1 - sampler.next_1d()));
  const float plain = make_gather_record(Vec3(0), h, samples, {}, 0).irradiance.x / kPi;
  const float once = make_gather_record(Vec3(0), h, samples, {}, 1).irradiance.x / kPi;
  const float most = make_gather_record(Vec3(0), h, samples, {}, 4).irradiance.x / kPi;
  EXPECT_NEAR(plain, 1, 0.05f);
  EXPECT_NEAR(once, std::log(2.0f) + 0.05f, 0.05f);
  EXPECT_NEAR(most, std::log(2.0f), 0.05f);
}

// ---- directional data

TEST(GatherLight, ConstantRadianceIsExactAtEveryRoughness) {
  const Vec3 n = normalize(Vec3(-1, 1, 2));
  const auto r = gather(Vec3(0), n, 100, [](const Vec3&, const Vec3&) { return Seen{3, 1}; });
  for (const Vec3& w : {n, Frame(n).s, -Frame(n).t, -n})
    for (const float roughness : {0.0f, 0.3f, 1.0f})
      EXPECT_NEAR(blurred_radiance(r, w, roughness).x, 3, 1e-3f);
}

TEST(GatherLight, CosineLobeIsNearlyExact) {
  // Lobes around the normal, and around directions tilted towards the horizon.
  for (const float tilt : {0.0f, 0.5f, 1.0f}) {
    const Vec3 n = normalize(Vec3(1, 1, 3)),
               axis = n * std::cos(tilt) + Frame(n).s * std::sin(tilt);
    const auto r = gather(Vec3(0), n, 1000, [&](const Vec3&, const Vec3& w) {
      return Seen{std::max(0.0f, dot(w, axis)), 1};
    });
    for (int i = 0; i < 50; ++i) {
      sampling::Sampler sampler(i, 0, 0);
      const auto h = GatherHemisphere::for_rays(n, 1);
      const Vec3 w = h.direction(i % 4, sampler.next_2d());
      EXPECT_NEAR(blurred_radiance(r, w, 0).x, std::max(0.0f, dot(w, axis)), 0.13f) << tilt;
    }
  }
}

TEST(GatherLight, RoughnessOneIsNearlyACosineLobe) {
  // Light linear in the direction: a cosine lobe around w sees 2/3 of the slope along w.
  const Vec3 g(0.4f, 0.2f, 0.1f);
  const auto r = gather(Vec3(0), kUp, 2000, [&](const Vec3&, const Vec3& w) {
    return Seen{1 + dot(g, w), 1};
  });
  const Vec3 w = normalize(Vec3(1, 0.3f, 1));
  EXPECT_NEAR(blurred_radiance(r, w, 1).x, 1 + 2 / 3.0f * dot(g, w), 0.02f);
  EXPECT_NEAR(blurred_radiance(r, w, 0).x, 1 + dot(g, w), 0.02f);
}

}  // namespace gather_record_test
}  // namespace oriel
