// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sampling/sampler.h"

namespace oriel {
namespace gather_share_test {

constexpr int kRays = 60;

/// A window: radiance 1 where the direction passes a rectangle in the plane x = 1.
float window(const Vec3& w) {
  if (w.x <= 0) return 0;
  const Vec3 p = w / w.x;
  return p.y > -.4f && p.y < .3f && p.z > .5f && p.z < 1.4f ? 1 : 0;
}

std::vector<GatherSample> first_rays(const GatherHemisphere& h, int seed) {
  std::vector<GatherSample> samples;
  for (int i = 0; i < h.count(); ++i) {
    sampling::Sampler sampler(i, seed, 0);
    samples.push_back({h.direction(i, sampler.next_2d()), Rgb(0)});
    samples.back().radiance = Rgb(window(samples.back().direction));
  }
  return samples;
}

/// Mean radiance, weighted by the cosine; with so many more rays.
double estimate(int seed, int more) {
  const auto h = GatherHemisphere::for_rays(Vec3(0, 0, 1), kRays);
  const auto samples = first_rays(h, seed);
  const auto shared = share_rays(samples, h.rings, h.sectors, more);
  double sum = 0;
  for (int i = 0; i < h.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    double stratum = samples[k].radiance.x;
    for (int j = 0; j < shared[k]; ++j) {
      sampling::Sampler sampler(i, seed, static_cast<std::uint32_t>(j + 1));
      stratum += window(h.direction(i, sampler.next_2d()));
    }
    sum += stratum / (1 + shared[k]);
  }
  return sum / h.count();
}

TEST(GatherShare, RaysAreDistributedByContrast) {
  const auto h = GatherHemisphere::for_rays(Vec3(0, 0, 1), 400);
  const auto samples = first_rays(h, 1);
  const auto shared = share_rays(samples, h.rings, h.sectors, 400);
  int near = 0, far = 0;
  for (std::size_t i = 0; i < shared.size(); ++i)
    (samples[i].direction.x > 0 ? near : far) += shared[i];
  EXPECT_GT(near, 300);
  EXPECT_LE(near, 400);
  EXPECT_EQ(far, 0);
}

TEST(GatherShare, EvenLightGetsNoMore) {
  const auto h = GatherHemisphere::for_rays(Vec3(0, 0, 1), 100);
  std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
  for (GatherSample& s : samples) s.radiance = Rgb(2);
  const auto shared = share_rays(samples, h.rings, h.sectors, 100);
  EXPECT_EQ(std::accumulate(shared.begin(), shared.end(), 0), 0);
  EXPECT_EQ(share_rays(samples, h.rings, h.sectors, 0), shared);
}

TEST(GatherShare, RoundingOfRadianceDoesNotMoveRays) {
  // One bright stratum: its neighbours get their half of the rays, in whole running totals.
  const auto h = GatherHemisphere::for_rays(Vec3(0, 0, 1), 64);
  for (int bright = 0; bright < h.count(); ++bright) {
    std::vector<GatherSample> samples(static_cast<std::size_t>(h.count()));
    for (GatherSample& s : samples) s.radiance = Rgb(.1f);
    samples[static_cast<std::size_t>(bright)].radiance = Rgb(3);
    const auto shared = share_rays(samples, h.rings, h.sectors, 64);
    EXPECT_EQ(std::accumulate(shared.begin(), shared.end(), 0), 32) << bright;
    for (const float scale : {.1f, .3f, .7f, 1.1f}) {
      auto scaled = samples;
      for (GatherSample& s : scaled) s.radiance *= scale;
      EXPECT_EQ(share_rays(scaled, h.rings, h.sectors, 64), shared) << bright << ' ' << scale;
    }
  }
}

// Four standard errors: 6e-5 of all seeds would miss it.
TEST(GatherShare, StaysUnbiasedAndLessNoisy) {
  const auto moments = [](int more, int runs) {
    double sum = 0, squares = 0;
    for (int i = 0; i < runs; ++i) {
      const double e = estimate(i, more);
      sum += e, squares += e * e;
    }
    const double mean = sum / runs;
    return std::pair(mean, squares / runs - mean * mean);
  };
  const auto [plain, plain_variance] = moments(0, 40000);
  const auto [shared, shared_variance] = moments(kRays, 40000);
  const double error = std::sqrt((plain_variance + shared_variance) / 40000);
  EXPECT_NEAR(shared, plain, 4 * error);
  EXPECT_LT(error, .005 * plain);
  // As many rays again, spread evenly, would halve it.
  EXPECT_LT(shared_variance, .5 * plain_variance);
}

}  // namespace gather_share_test
}  // namespace oriel
