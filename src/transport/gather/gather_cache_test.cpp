// SPDX-License-Identifier: Apache-2.0
// The irradiance cache: which records speak, what they say, and that order and batches cannot
// matter.
#include "transport/gather/gather_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "sampling/sampler.h"
#include "transport/gather/gather_test_records.h"

namespace oriel {
namespace gather_cache_test {

using gather_records::at;
using gather_records::kUp;
using gather_records::record;
using gather_records::strewn;

bool same(const std::optional<Gathered>& a, const std::optional<Gathered>& b) {
  if (!a || !b) return !a == !b;
  return a->irradiance == b->irradiance && a->records == b->records && a->fade == b->fade;
}

// Irradiance x^2 with its gradient 2 x: the error of a record at distance d is d^2.
TEST(GatherCache, CurvatureShortensRadii) {
  GatherCache cache;
  for (int i = 0; i <= 10; ++i) {
    const float x = 1 + 0.1f * static_cast<float>(i);
    GatherRecord r = record(Vec3(x, 0, 0), x * x, 5);
    r.by_position = {Vec3(2 * x, 0, 0), Vec3(2 * x, 0, 0), Vec3(2 * x, 0, 0)};
    cache.insert({&r, 1});
  }
  cache.shorten_by_curvature(0.1f);
  // The first neighbour that is wrong by more sets it: radius^2 / E there = tolerance.
  EXPECT_NEAR(cache.radius(0), std::sqrt(0.1f * 2.25f), 1e-3f);
  EXPECT_NEAR(cache.radius(10), std::sqrt(0.1f * 4), 1e-3f);
}

TEST(GatherCache, BestRecordsAreThoseOfLeastError) {
  GatherCache cache;
  const GatherRecord near = record(Vec3(0.2f, 0, 0), 1, 0.25f), far = record(Vec3(0, 1, 0), 2, 10);
  cache.insert({&near, 1});
  cache.insert({&far, 1});
  GatherQuery q = at(Vec3(0), 1);
  EXPECT_FLOAT_EQ(cache.interpolate(q)->irradiance.x, 1) << "the nearest";
  q.by_error = true;
  EXPECT_FLOAT_EQ(cache.interpolate(q)->irradiance.x, 2) << "error .1 against .8";
  q.accuracy = 0.05f;
  EXPECT_FALSE(cache.interpolate(q));
}

TEST(GatherCache, EmptyCacheReturnsNothing) {
  GatherCache cache;
  EXPECT_FALSE(cache.interpolate(at(Vec3(0))));
  EXPECT_FALSE(cache.interpolate(at(Vec3(0), 5)));
  cache.clamp_to_neighbours();
  EXPECT_TRUE(cache.empty());
}

TEST(GatherCache, LinearFieldIsReproducedInBothModes) {
  const Vec3 gradient(0.8f, -0.5f, 0);
  const auto field = [&](const Vec2& p) { return 2 + gradient.x * p.x + gradient.y * p.y; };
  GatherCache cache;
  cache.insert(strewn(200, 0.2f, field, gradient));
  for (int i = 0; i < 200; ++i) {
    const Vec2 p = sampling::Sampler(9, 9, static_cast<std::uint32_t>(i)).next_2d();
    for (const int points : {0, 1, 10, 100}) {
      const auto g = cache.interpolate(at(Vec3(p.x, p.y, 0), points));
      ASSERT_TRUE(g);
      EXPECT_NEAR(g->irradiance.x, field(p), 2e-5f) << points;
      if (points > 0) {
        EXPECT_LE(g->records, points);
      }
    }
  }
}

TEST(GatherCache, RecordReturnsItsOwnIrradiance) {
  GatherCache cache;
  cache.insert(strewn(100, 0.3f, [](const Vec2& p) { return std::exp(p.x * 3); }));
  for (const GatherRecord& r : cache.records())
    EXPECT_NEAR(cache.interpolate(at(r.position))->irradiance.x, r.irradiance.x,
                1e-3f * r.irradiance.x);
}

TEST(GatherCache, ErrorBoundLimitsTheReach) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), 1, 2)});
  EXPECT_TRUE(cache.interpolate(at(Vec3(1.9f, 0, 0))));
  EXPECT_FALSE(cache.interpolate(at(Vec3(2.1f, 0, 0))));
  GatherQuery q = at(Vec3(0.5f, 0, 0));
  q.accuracy = 0.3f;
  EXPECT_TRUE(cache.interpolate(q));
  q.accuracy = 0.2f;
  EXPECT_FALSE(cache.interpolate(q));
}

TEST(GatherCache, RadiiInPixelsFollowTheFootprint) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), 1, 2)});
  const GatherRadii pixels{5, 50, true};
  GatherQuery q = at(Vec3(1, 0, 0));
  q.radii = pixels.in_scene(0.01f);  // at most 0.5
  EXPECT_FALSE(cache.interpolate(q));
  q.radii = pixels.in_scene(0.05f);
  EXPECT_TRUE(cache.interpolate(q));
  q.position.x = 9;
  EXPECT_FALSE(cache.interpolate(q));
  q.radii = pixels.in_scene(2);  // at least 10
  EXPECT_TRUE(cache.interpolate(q));
}

TEST(GatherCache, OtherOrientationsAreNotUsed) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), 1, 10, Vec3(1, 0, 0)), record(Vec3(0), 1, 10, -kUp)});
  for (const int points : {0, 3}) {
    EXPECT_FALSE(cache.interpolate(at(Vec3(0, 0, 0), points)));
    // Both sides of a sheet.
    EXPECT_TRUE(cache.interpolate(at(Vec3(0, 0, 0), points, -kUp)));
    EXPECT_TRUE(cache.interpolate(at(Vec3(0, 0, 0), points, normalize(Vec3(1, 0.2f, 0)))));
  }
}

TEST(GatherCache, RecordInFrontIsNotUsedOneOnTheSurfaceIs) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0, 0, 0.5f), 1, 1)});
  for (const int points : {0, 3}) {
    EXPECT_FALSE(cache.interpolate(at(Vec3(0.2f, 0, 0), points)));
    EXPECT_TRUE(cache.interpolate(at(Vec3(0.2f, 0, 0.5f), points)));
    EXPECT_TRUE(cache.interpolate(at(Vec3(0.2f, 0, 0.7f), points)));
    // A storey above.
    EXPECT_FALSE(cache.interpolate(at(Vec3(0.2f, 0, 1.6f), points)));
  }
}

TEST(GatherCache, CurvedSurfacesShareRecords) {
  // Unit sphere, outside and inside; records and point lie 9 degrees apart.
  const Vec3 a(0, 0, 1), b = normalize(Vec3(0.16f, 0, 1));
  for (const float side : {1.0f, -1.0f}) {
    GatherCache cache;
    cache.insert(std::vector{record(a, 1, 1, a * side)});
    for (const int points : {0, 3})
      EXPECT_TRUE(cache.interpolate(at(b, points, b * side))) << side << points;
  }
}

/// A floor point beside an endless wall through x = 0: rays that go to the other side hit it.
GatherRecord beside_wall(float x, float e, const GatherRadii& radii = {2, 2}) {
  const auto h = GatherHemisphere::for_rays(kUp, 100);
  std::vector<GatherSample> samples;
  for (int i = 0; i < h.count(); ++i) {
    const Vec3 w = h.direction(i, Vec2(0.5f));
    const float t = x * w.x < 0 ? -x / w.x : 8;
    samples.push_back({w, Rgb(e / kPi), t});
  }
  return make_gather_record(Vec3(x, 0.3f, 0), h, samples, radii);
}

TEST(GatherCache, RecordIsNotUsedThroughAWall) {
  GatherCache cache;
  // Bright on the left; nobody on the right yet.
  cache.insert(std::vector{beside_wall(-0.3f, 5), beside_wall(-0.6f, 5), beside_wall(-1, 5)});
  for (const int points : {0, 1, 10}) {
    for (const float y : {0.0f, 0.3f, 0.8f}) {
      EXPECT_FALSE(cache.interpolate(at(Vec3(0.12f, y, 0), points))) << points << " " << y;
      EXPECT_FALSE(cache.interpolate(at(Vec3(0.5f, y, 0), points))) << points << " " << y;
      EXPECT_TRUE(cache.interpolate(at(Vec3(-0.2f, y, 0), points))) << points << " " << y;
    }
    GatherQuery q = at(Vec3(0.12f, 0.3f, 0), points);
    q.through_walls = true;
    EXPECT_TRUE(cache.interpolate(q));
  }
  cache.insert(std::vector{beside_wall(0.4f, 1)});
  for (const int points : {0, 1, 10})
    EXPECT_NEAR(cache.interpolate(at(Vec3(0.12f, 0.3f, 0), points))->irradiance.x, 1, 1e-3f);
}

TEST(GatherCache, RecordIsNotUsedBehindACorner) {
  // The wall ends at y = 0: it stands where y < 0. From (-0.5, -1) the way to (0.5, -1) is shut,
  // the way along it is open.
  const Vec3 position(-0.5f, -1, 0);
  const auto h = GatherHemisphere::for_rays(kUp, 400);
  std::vector<GatherSample> samples;
  for (int i = 0; i < h.count(); ++i) {
    const Vec3 w = h.direction(i, Vec2(0.5f));
    const float t = w.x > 0 ? 0.5f / w.x : kGatherFarthest;
    samples.push_back({w, Rgb(1), -1 + t * w.y < 0 ? t : kGatherFarthest});
  }
  GatherCache cache;
  cache.insert(std::vector{make_gather_record(position, h, samples, {3, 3})});
  for (const int points : {0, 4}) {
    EXPECT_FALSE(cache.interpolate(at(Vec3(0.5f, -1, 0), points)));
    EXPECT_FALSE(cache.interpolate(at(Vec3(0.3f, -0.7f, 0), points)));
    EXPECT_TRUE(cache.interpolate(at(Vec3(-0.5f, 0.8f, 0), points)));
    EXPECT_TRUE(cache.interpolate(at(Vec3(-1.5f, -1, 0), points)));
  }
}

TEST(GatherCache, NeighbourClampingObeysTheTriangle) {
  std::vector<GatherRecord> records;
  for (int i = 0; i < 500; ++i) {
    sampling::Sampler s(1, 1, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const float r = s.next_1d();
    records.push_back(record(Vec3(u.x, u.y, s.next_1d()), 1, 0.02f + r * r));
  }
  GatherCache cache;
  cache.insert(records);
  cache.clamp_to_neighbours();
  int shortened = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    float expected = records[i].radius;
    for (std::size_t j = 0; j < records.size(); ++j) {
      const float d = length(records[i].position - records[j].position);
      EXPECT_LE(cache.radius(i), cache.radius(j) + d + 1e-6f);
      expected = std::min(expected, records[j].radius + d);
    }
    EXPECT_EQ(cache.radius(i), expected);
    shortened += expected < records[i].radius;
  }
  EXPECT_GT(shortened, 100);
}

TEST(GatherCache, ClampedRadiiRuleTheLookUp) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), 1, 5)});
  EXPECT_TRUE(cache.interpolate(at(Vec3(0, 3, 0))));
  cache.insert(std::vector{record(Vec3(1, 0, 0), 1, 0.5f)});
  cache.clamp_to_neighbours();
  EXPECT_FLOAT_EQ(cache.radius(0), 1.5f);
  EXPECT_FALSE(cache.interpolate(at(Vec3(0, 3, 0))));
}

TEST(GatherCache, NearestPointsAreContinuousAlongALine) {
  GatherCache cache;
  // No gradients: values jump wherever a record enters with weight. One record in five is turned
  // and fades as the normal swings.
  auto records =
      strewn(300, 0.4f, [](const Vec2& p) { return 1 + std::sin(40 * p.x) * std::cos(50 * p.y); });
  for (std::size_t i = 0; i < records.size(); i += 5)
    records[i].normal = normalize(Vec3(0.35f, 0, 1));
  cache.insert(records);
  const auto largest_step = [&](int points, int steps) {
    float before = 0, largest = 0;
    for (int i = 0; i <= steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      const Vec3 normal = normalize(Vec3(0.4f * (t - 0.5f), 0.1f, 1));
      const auto g = cache.interpolate(at(Vec3(t, 0.2f + 0.5f * t, 0), points, normal));
      const float value = g ? g->irradiance.x : -100;
      if (i > 0) largest = std::max(largest, std::abs(value - before));
      before = value;
    }
    return largest;
  };
  // A slope's steps shrink with their length; a jump's do not.
  for (const int points : {3, 10, 50})
    EXPECT_LT(largest_step(points, 20000), 0.2f * largest_step(points, 2000)) << points;
}

TEST(GatherCache, NearestFadesOutAtTheRadius) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), 1, 5)});
  GatherQuery q = at(Vec3(0), 4);
  q.radii.max = 2;
  float before = 1;
  for (float x = 0; x < 2; x += 0.05f) {
    q.position.x = x;
    const auto g = cache.interpolate(q);
    ASSERT_TRUE(g);
    EXPECT_LE(g->fade, before);
    before = g->fade;
  }
  EXPECT_LT(before, 0.01f);
  q.position.x = 2.01f;
  EXPECT_FALSE(cache.interpolate(q));
}

TEST(GatherCache, NearestAgreesWithSearchingAll) {
  const auto records = strewn(1000, 1, [](const Vec2& p) { return p.x; });
  GatherCache cache;
  cache.insert(records);
  for (int i = 0; i < 50; ++i) {
    const Vec2 u = sampling::Sampler(5, 5, static_cast<std::uint32_t>(i)).next_2d();
    const Vec3 p(u.x * 1.4f - 0.2f, u.y * 1.4f - 0.2f, 0);
    std::vector<std::pair<float, float>> all;
    for (const auto& r : records) all.emplace_back(length(r.position - p), r.irradiance.x);
    std::sort(all.begin(), all.end());
    double sum = 0, weight = 0;
    for (std::size_t k = 0; k < 20; ++k) {
      const double w = std::pow(1 - std::pow(double(all[k].first / all[20].first), 2), 2);
      sum += w * double(all[k].second);
      weight += w;
    }
    EXPECT_NEAR(cache.interpolate(at(p, 20))->irradiance.x, sum / weight, 1e-5);
  }
}

TEST(GatherCache, BatchesDoNotMatter) {
  auto records = strewn(700, 0.15f, [](const Vec2& p) { return p.x + p.y; });
  for (std::size_t i = 0; i < records.size(); i += 7) {
    records[i].position = records[i].position * 50.0f - Vec3(9);  // makes the root grow on the way
    records[i].radius = 0.01f;
  }
  GatherCache whole, parts;
  whole.insert(records);
  whole.clamp_to_neighbours();
  for (std::size_t i = 0, size = 1; i < records.size(); i += size, size = size % 37 + 3) {
    parts.insert(std::span(records).subspan(i, std::min(size, records.size() - i)));
    if (size % 2) parts.clamp_to_neighbours();
  }
  parts.clamp_to_neighbours();
  for (std::size_t i = 0; i < records.size(); ++i) EXPECT_EQ(whole.radius(i), parts.radius(i));
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u = sampling::Sampler(2, 2, static_cast<std::uint32_t>(i)).next_2d();
    for (const int points : {0, 7}) {
      const auto q = at(Vec3(u.x, u.y, 0), points);
      EXPECT_TRUE(same(whole.interpolate(q), parts.interpolate(q)));
    }
  }
}

TEST(GatherCache, ManyRecordsInOnePlaceAreHeld) {
  const std::vector<GatherRecord> records(1000, record(Vec3(3, 4, 5), 2));
  GatherCache cache;
  EXPECT_EQ(cache.insert(records), 1000u);
  EXPECT_NEAR(cache.interpolate(at(Vec3(3, 4, 5)))->irradiance.x, 2, 1e-4f);
  EXPECT_NEAR(cache.interpolate(at(Vec3(3, 4.1f, 5), 10))->irradiance.x, 2, 1e-4f);
}

TEST(GatherCache, UnusableRecordsAreRejected) {
  const float nan = std::nanf("");
  std::vector<GatherRecord> bad(7, record(Vec3(0), 1));
  bad[0].position.x = nan;
  bad[1].irradiance.y = nan;
  bad[2].normal = Vec3(0);
  bad[3].radius = 0;
  bad[4].by_position[2].z = std::numeric_limits<float>::infinity();
  bad[5].irradiance.z = -1;
  bad[6].position.y = 1e30f;
  GatherCache cache;
  EXPECT_EQ(cache.insert(bad), 0u);
  EXPECT_TRUE(cache.empty());
}

TEST(GatherCache, ResultsAreNeverNegative) {
  auto records = strewn(
      100, 1, [](const Vec2& p) { return p.x * p.y; }, Vec3(-30, 20, 0));
  GatherCache cache;
  cache.insert(records);
  for (int i = 0; i < 500; ++i) {
    const Vec2 u = sampling::Sampler(4, 4, static_cast<std::uint32_t>(i)).next_2d();
    for (const int points : {0, 10})
      EXPECT_GE(cache.interpolate(at(Vec3(u.x, u.y, 0), points))->irradiance.x, 0);
  }
}

TEST(GatherCache, DirectionalDataIsMixedOnRequest) {
  GatherCache cache;
  cache.insert(std::vector{record(Vec3(0), kPi), record(Vec3(0.2f, 0, 0), 3 * kPi)});
  GatherQuery q = at(Vec3(0.1f, 0, 0));
  EXPECT_EQ(cache.interpolate(q)->incoming.mean, Rgb(0));
  q.directional = true;
  EXPECT_NEAR(blurred_radiance(cache.interpolate(q)->incoming, kUp, 0.5f).x, 2, 1e-4f);
}

/// Figures, not a test: run with --gtest_also_run_disabled_tests.
TEST(GatherCache, DISABLED_LookUpsPerSecond) {
  // A room of 4 x 4 x 3: floor, ceiling, four walls.
  constexpr int kRecords = 20000, kLookUps = 400000;
  const auto somewhere = [](std::uint32_t i) {
    sampling::Sampler s(3, 3, i);
    const Vec2 u = s.next_2d();
    const int face = static_cast<int>(s.next_1d() * 6);
    Vec3 p(u.x, u.y, 0);
    Vec3 n(0);
    const int axis = face / 2;
    p = axis == 0 ? Vec3(0, u.x, u.y) : (axis == 1 ? Vec3(u.x, 0, u.y) : Vec3(u.x, u.y, 0));
    p[axis] = static_cast<float>(face % 2);
    n[axis] = face % 2 ? -1 : 1;
    return std::pair(Vec3(p.x * 4, p.y * 4, p.z * 3), n);
  };
  std::vector<GatherRecord> records;
  for (std::uint32_t i = 0; i < kRecords; ++i) {
    const auto [p, n] = somewhere(i);
    const auto h = GatherHemisphere::for_rays(n, 20);
    std::vector<GatherSample> samples;
    for (int k = 0; k < h.count(); ++k) {
      const Vec3 w = h.direction(k, Vec2(0.5f));
      float t = 1e9f;
      for (int a = 0; a < 3; ++a) {
        const float side = a == 2 ? 3.0f : 4.0f;
        if (std::abs(w[a]) > 1e-6f) t = std::min(t, ((w[a] > 0 ? side : 0) - p[a]) / w[a]);
      }
      samples.push_back({w, Rgb(1), std::max(t, 1e-3f)});
    }
    records.push_back(make_gather_record(p, h, samples, {0.02f, 0.2f}));
  }
  // Time of the processor, since others may share it.
  const auto since = [](std::clock_t t) {
    return static_cast<double>(std::clock() - t) / CLOCKS_PER_SEC;
  };
  GatherCache cache;
  std::clock_t start = std::clock();
  cache.insert(records);
  std::printf("insert %.2f M/s, ", kRecords / since(start) * 1e-6);
  start = std::clock();
  cache.clamp_to_neighbours();
  std::printf("clamp %.2f M/s\n", kRecords / since(start) * 1e-6);
  // Anywhere, which mostly waits for memory, and along rows of the floor, as pictures ask.
  const auto row = [](std::uint32_t i) {
    return std::pair(Vec3(static_cast<float>(i % 640), static_cast<float>(i / 640), 0) / 160.0f,
                     kUp);
  };
  for (const bool in_rows : {false, true})
    for (const int points : {0, 10, 50}) {
      start = std::clock();
      long spoke = 0, answered = 0;
      for (std::uint32_t i = 0; i < kLookUps; ++i) {
        const auto [p, n] = in_rows ? row(i) : somewhere(kRecords + i);
        const auto g = cache.interpolate(at(p, points, n));
        if (g) ++answered, spoke += g->records;
      }
      std::printf("%s, points %d: %.2f M look-ups/s, %.1f records each, %.2f %% answered\n",
                  in_rows ? "in rows" : "anywhere", points, kLookUps / since(start) * 1e-6,
                  double(spoke) / double(answered), 100.0 * double(answered) / kLookUps);
    }
}

}  // namespace gather_cache_test
}  // namespace oriel
