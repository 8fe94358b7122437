// SPDX-License-Identifier: Apache-2.0
#include "sampling/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sampling/testing/chi_square.h"

namespace oriel::sampling {
namespace sampler_test {

TEST(Sampler, IsAFunctionOfItsKeyAlone) {
  Sampler a(3, 5, 7, 11), b;
  b.start(3, 5, 7, 11);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.next_1d(), b.next_1d());
    EXPECT_EQ(a.next_2d(), b.next_2d());
  }
  Sampler jumped(3, 5, 7, 11);
  jumped.set_dimension(a.dimension());
  EXPECT_EQ(a.next_2d(), jumped.next_2d());
  const Vec2 first = Sampler(3, 5, 7, 11).next_2d();
  EXPECT_NE(first, Sampler(5, 3, 7, 11).next_2d());
  EXPECT_NE(first, Sampler(3, 5, 7, 12).next_2d());
  EXPECT_NE(first, Sampler(3, 5, 8, 11).next_2d());
}

TEST(Sampler, StaysBelowOne) {
  for (std::uint32_t n = 0; n < 200000; ++n) {
    Sampler s(static_cast<int>(n), 1, n * 2654435761u);
    const Vec2 u = s.next_2d();
    const float v = s.next_1d();
    ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1 && v >= 0 && v < 1);
  }
}

// Every elementary interval of area 2^-k holds exactly one of 2^k consecutive aligned samples.
TEST(Sampler, EveryAlignedBlockIsANet) {
  for (std::uint32_t dimension = 0; dimension < 4; ++dimension)
    for (int k = 0; k <= 8; ++k) {
      const std::uint32_t n = 1u << k;
      for (const std::uint32_t first : {0u, n, 37 * n}) {
        std::vector<Vec2> points;
        std::vector<int> line(n);
        for (std::uint32_t i = 0; i < n; ++i) {
          Sampler s(17, 4, first + i, 9);
          s.set_dimension(dimension);
          points.push_back(s.next_2d());
          ++line[static_cast<std::size_t>(s.next_1d() * static_cast<float>(n))];
        }
        for (const int count : line) ASSERT_EQ(count, 1);
        for (int a = 0; a <= k; ++a) {
          std::vector<int> cells(n);
          for (const Vec2& p : points) {
            const auto x = static_cast<std::uint32_t>(p.x * static_cast<float>(1u << a));
            const auto y = static_cast<std::uint32_t>(p.y * static_cast<float>(1u << (k - a)));
            ++cells[(x << (k - a)) + y];
          }
          for (const int count : cells) ASSERT_EQ(count, 1) << "k " << k << " a " << a;
        }
      }
    }
}

double rmse(int samples, bool smooth) {
  constexpr int kRuns = 256;
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    double mean = 0;
    for (int i = 0; i < samples; ++i) {
      const Vec2 u = Sampler(run, 77, static_cast<std::uint32_t>(i)).next_2d();
      // exp(x + y) is smooth; the indicator of the quarter disc has an edge.
      mean += smooth ? std::exp(double{u.x} + double{u.y}) : (u.x * u.x + u.y * u.y < 1 ? 1.0 : 0);
    }
    const double e = std::exp(1.0) - 1;
    const double d = mean / samples - (smooth ? e * e : double{kPi} / 4);
    sum += d * d;
  }
  return std::sqrt(sum / kRuns);
}

// Owen: N^-1.5 for smooth integrands; N^-0.75 across an edge; random sampling has N^-0.5.
TEST(Sampler, ErrorFallsFasterThanRandom) {
  EXPECT_NEAR(std::log2(rmse(16, true) / rmse(1024, true)) / 6, 1.5, 0.12);
  EXPECT_NEAR(std::log2(rmse(16, false) / rmse(1024, false)) / 6, 0.75, 0.1);
}

/// Chi-square of coordinate `ca` of draw `a` against coordinate `cb` of draw `b`.
template <typename Key>
double independence(std::uint32_t a, int ca, std::uint32_t b, int cb, int count, const Key& key) {
  constexpr int kCells = 12;
  std::vector<double> observed(kCells * kCells);
  const std::vector<double> expected(kCells * kCells, double(count) / (kCells * kCells));
  for (int n = 0; n < count; ++n) {
    Sampler s = key(n), t = s;
    s.set_dimension(a);
    t.set_dimension(b);
    const auto x = static_cast<int>(s.next_2d()[ca] * kCells);
    const auto y = static_cast<int>(t.next_2d()[cb] * kCells);
    observed[static_cast<std::size_t>(x * kCells + y)] += 1;
  }
  return testing::chi_square(observed, expected).p_value;
}

// Across pixels (independent draws, so the test is exact) and over the samples of one pixel, where
// stratification lowers the statistic but correlation between draws would raise it.
TEST(Sampler, DimensionsAreIndependent) {
  constexpr std::uint32_t kDraws = 8;
  const double level = testing::sidak(0.01, 2 * 4 * kDraws * (kDraws - 1) / 2);
  for (std::uint32_t a = 0; a < kDraws; ++a)
    for (std::uint32_t b = a + 1; b < kDraws; ++b)
      for (int c = 0; c < 4; ++c) {
        const int ca = c & 1, cb = c >> 1;
        EXPECT_GT(independence(a, ca, b, cb, 20000,
                               [](int n) { return Sampler(n % 141, n / 141, 5, 1); }),
                  level)
            << a << '.' << ca << " with " << b << '.' << cb << " across pixels";
        EXPECT_GT(independence(a, ca, b, cb, 16384,
                               [](int n) { return Sampler(8, 9, static_cast<std::uint32_t>(n)); }),
                  level)
            << a << '.' << ca << " with " << b << '.' << cb << " in one pixel";
      }
}

/// Number of points in each cell of every division of the square into 2^k cells of equal area.
void expect_net(const std::vector<Vec2>& points, int k, const std::string& what) {
  const std::size_t n = points.size();
  ASSERT_EQ(n % (std::size_t{1} << k), 0u);
  const int wanted = static_cast<int>(n >> k);
  for (int a = 0; a <= k; ++a) {
    std::vector<int> cells(std::size_t{1} << k);
    for (const Vec2& p : points) {
      const auto x = static_cast<std::uint32_t>(p.x * static_cast<float>(1u << a));
      const auto y = static_cast<std::uint32_t>(p.y * static_cast<float>(1u << (k - a)));
      ++cells[(x << (k - a)) + y];
    }
    for (const int count : cells) ASSERT_EQ(count, wanted) << what << " k " << k << " a " << a;
  }
}

TEST(Sampler, SplitStreamsOfAllSamplesAreANetTogether) {
  // 2^s samples that split into n = 2^m streams each: 2^(s + m) points, as well stratified as a
  // net.
  for (const int m : {1, 3, 4})
    for (const int s : {0, 2, 4}) {
      const std::uint32_t n = 1u << m, samples = 1u << s;
      for (std::uint32_t draw = 0; draw < 3; ++draw) {
        std::vector<Vec2> points;
        for (std::uint32_t i = 0; i < samples; ++i)
          for (std::uint32_t j = 0; j < n; ++j) {
            Sampler stream = Sampler(5, 9, i, 2).split(j, n, 3);
            stream.set_dimension(12 + draw);
            points.push_back(stream.next_2d());
          }
        expect_net(points, s + m, "streams " + std::to_string(n));
      }
    }
}

TEST(Sampler, SplitsOfOtherNumbersCountOnWithoutGaps) {
  // Streams of samples 0, 1, 2 ... that split into n are the points 0, n, 2 n ... and those in
  // between: the first 2^k are a net for any k.
  constexpr std::uint32_t kStreams = 5;
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; points.size() < 64; ++i)
    for (std::uint32_t j = 0; j < kStreams && points.size() < 64; ++j) {
      Sampler stream = Sampler(1, 2, i).split(j, kStreams, 0);
      points.push_back(stream.next_2d());
    }
  expect_net(points, 6, "fives");
}

TEST(Sampler, SplitIntoOneIsAsEvenAsTheSampleWas) {
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < 64; ++i) {
    Sampler stream = Sampler(3, 3, i).split(0, 1, 7);
    points.push_back(stream.next_2d());
  }
  expect_net(points, 6, "one");
}

TEST(Sampler, SplittingLeavesTheSampleAsItWas) {
  Sampler a(4, 4, 1), b(4, 4, 1);
  a.next_2d();
  b.next_2d();
  const Sampler stream = a.split(2, 4, 1);
  EXPECT_EQ(stream.dimension(), a.dimension());
  EXPECT_EQ(a.next_2d(), b.next_2d());
}

TEST(Sampler, BranchesAreIndependent) {
  // Independent of each other, of the original sample, and of subsequent draws: in one pixel and
  // across pixels.
  constexpr int kCells = 12, kCount = 16384;
  const auto first = [](Sampler s) { return s.next_2d(); };
  struct Pair {
    std::uint32_t a, b;
    bool a_splits;
  };
  const Pair pairs[] = {{0, 1, true},  {0, 2, true},  {1, 7, true},    {0, 1000, true},
                        {0, 0, false}, {0, 1, false}, {0, 1000, false}};
  const double least = testing::sidak(0.01, 2 * 4 * static_cast<int>(std::size(pairs)));
  const std::vector<double> expected(kCells * kCells, double(kCount) / (kCells * kCells));
  for (const bool one_pixel : {false, true})
    for (const Pair& pair : pairs)
      for (int c = 0; c < 4; ++c) {
        std::vector<double> observed(kCells * kCells);
        for (int n = 0; n < kCount; ++n) {
          const Sampler s = one_pixel ? Sampler(8, 9, static_cast<std::uint32_t>(n))
                                      : Sampler(n % 141, n / 141, 5, 1);
          const auto j = static_cast<std::uint32_t>(n % 4);
          const Vec2 u = first(pair.a_splits ? s.split(j, 4, pair.a) : s);
          const Vec2 v = first(s.split(j, 4, pair.b));
          const auto x = static_cast<int>(u[c & 1] * kCells);
          const auto y = static_cast<int>(v[c >> 1] * kCells);
          observed[static_cast<std::size_t>(x * kCells + y)] += 1;
        }
        EXPECT_GT(testing::chi_square(observed, expected).p_value, least)
            << pair.a << " with " << pair.b << " coordinates " << c << " one pixel " << one_pixel;
      }
}

TEST(Sampler, NeighbouringPixelsAreIndependent) {
  constexpr int kCells = 16, kCount = 40000;
  std::vector<double> observed(kCells * kCells);
  for (int n = 0; n < kCount; ++n) {
    const float x = Sampler(2 * n, 3, 0).next_1d(), y = Sampler(2 * n + 1, 3, 0).next_1d();
    observed[static_cast<std::size_t>(x * kCells) * kCells +
             static_cast<std::size_t>(y * kCells)] += 1;
  }
  const std::vector<double> expected(kCells * kCells, double(kCount) / (kCells * kCells));
  EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

}  // namespace sampler_test
}  // namespace oriel::sampling
