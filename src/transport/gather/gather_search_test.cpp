// SPDX-License-Identifier: Apache-2.0
// Look-ups of the irradiance cache by error: the records that are found, and their weights.
#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "sampling/sampler.h"
#include "transport/gather/gather_test_records.h"

namespace oriel {
namespace gather_search_test {

using gather_records::at;
using gather_records::kUp;
using gather_records::record;
using gather_records::strewn;

// Irradiance 1 + x^2 with its gradient 2 x: a record is too dark by the square of the distance.
TEST(GatherCache, OfExactRecordsNearerOnesCount) {
  const auto error = [](float noise) {
    GatherCache cache;
    for (int i = -10; i <= 10; ++i) {
      const float x = 0.1f * static_cast<float>(i);
      GatherRecord r = record(Vec3(x, 0, 0), 1 + x * x, 1);
      r.by_position = {Vec3(2 * x, 0, 0), Vec3(2 * x, 0, 0), Vec3(2 * x, 0, 0)};
      r.noise = noise;
      cache.insert({&r, 1});
    }
    GatherQuery q = at(Vec3(0), 9);
    q.by_error = true;
    return 1 - cache.interpolate(q)->irradiance.x;
  };
  EXPECT_GT(error(1), 0.03f) << "the mean of many";
  EXPECT_LT(error(0), 0.01f) << "nearly that at the place itself";
  EXPECT_GT(error(0.01f), error(0));
  EXPECT_LT(error(0.01f), error(1));
}

TEST(GatherCache, NoisyRecordsAreAveraged) {
  const auto squared_error = [](float noise_known) {
    GatherCache cache;
    auto records = strewn(400, 0.2f, [](const Vec2&) { return 1.0f; });
    for (std::size_t i = 0; i < records.size(); ++i) {
      const float u = sampling::Sampler(3, 0, static_cast<std::uint32_t>(i)).next_1d();
      records[i].irradiance = Rgb(1 + 0.4f * (u - 0.5f));
      records[i].noise = noise_known;
    }
    cache.insert(records);
    double sum = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec2 u = sampling::Sampler(4, 0, static_cast<std::uint32_t>(i)).next_2d();
      GatherQuery q = at(Vec3(u.x, u.y, 0), 10);
      q.by_error = true;
      sum += sqr(double(cache.interpolate(q)->irradiance.x) - 1);
    }
    return sum / 500;
  };
  // The standard deviation is .4 / sqrt(12). Nine equal weights would leave a ninth of its square.
  const double one = 0.4 * 0.4 / 12, known = squared_error(0.115f), unknown = squared_error(0);
  EXPECT_LT(known, one / 4);
  EXPECT_GT(unknown, 1.3 * known);
}

// The tree skips nodes by place, error and normal; a cache of one record has a single node.
TEST(GatherCache, RecordsOfAllNormalsAreFound) {
  constexpr int kRecords = 250;
  GatherCache all;
  std::vector<GatherCache> alone(kRecords);
  const auto normal_of = [](const Vec2& u) {
    const float z = 2 * u.x - 1, r = std::sqrt(std::max(0.0f, 1 - z * z));
    return Vec3(r * std::cos(kTwoPi * u.y), r * std::sin(kTwoPi * u.y), z);
  };
  for (int i = 0; i < kRecords; ++i) {
    sampling::Sampler s(1, 0, static_cast<std::uint32_t>(i));
    const Vec2 xy = s.next_2d();
    const Vec3 place(xy.x, xy.y, s.next_1d());
    const GatherRecord r = record(place, 1, 0.2f + s.next_1d(), normal_of(s.next_2d()));
    all.insert({&r, 1});
    alone[static_cast<std::size_t>(i)].insert({&r, 1});
  }
  int found_in_all = 0;
  for (int k = 0; k < 400; ++k) {
    sampling::Sampler s(2, 0, static_cast<std::uint32_t>(k));
    const Vec2 xy = s.next_2d();
    GatherQuery q = at(Vec3(xy.x, xy.y, s.next_1d()), 0, normal_of(s.next_2d()));
    q.min_cosine = k % 4 < 2 ? 0.9f : -0.5f;
    if (k % 2 == 1) q.points = GatherCache::kMaxPoints, q.by_error = true;
    int expected = 0;
    for (const GatherCache& one : alone) expected += one.interpolate(q) ? 1 : 0;
    const auto found = all.interpolate(q);
    EXPECT_EQ(found ? found->records : 0, expected) << "query " << k;
    found_in_all += expected;
  }
  EXPECT_GT(found_in_all, 400);
}

}  // namespace gather_search_test
}  // namespace oriel
