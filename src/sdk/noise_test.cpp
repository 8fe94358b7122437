// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "oriel/sdk/shader/sample.h"
#include "sampling/sampler.h"
#include "sdk/lattice_noise.h"

namespace noise_test {

using oriel::sampling::Sampler;

constexpr int kPlaces = 100000;

/// Places up to 3000 units from the origin.
miVector place(int i) {
  Sampler s(i, 0, 0, 5);
  const oriel::Vec2 u = s.next_2d();
  return {6000 * u.x - 3000, 6000 * u.y - 3000, 6000 * s.next_1d() - 3000};
}

struct Kind {
  const char* name;
  float (*value)(const miVector&);
};
const Kind kBells[] = {{"1d", [](const miVector& p) { return mi_noise_1d(p.x); }},
                       {"2d", [](const miVector& p) { return mi_noise_2d(p.x, p.y); }},
                       {"3d", [](const miVector& p) { return mi_noise_3d(&p); }}};
const Kind kEven[] = {{"1d", [](const miVector& p) { return mi_unoise_1d(p.x); }},
                      {"2d", [](const miVector& p) { return mi_unoise_2d(p.x, p.y); }},
                      {"3d", [](const miVector& p) { return mi_unoise_3d(&p); }}};

std::vector<float> sorted_values(const Kind& kind) {
  std::vector<float> values(kPlaces);
  for (int i = 0; i < kPlaces; ++i) values[static_cast<std::size_t>(i)] = kind.value(place(i));
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Noise, IsABellAboutOneHalfWithinZeroAndOne) {
  for (const Kind& kind : kBells) {
    const std::vector<float> v = sorted_values(kind);
    double mean = 0, square = 0;
    for (const float x : v) mean += x / kPlaces, square += (x - .5) * (x - .5) / kPlaces;
    EXPECT_NEAR(mean, .5, .003) << kind.name;
    EXPECT_NEAR(std::sqrt(square), .14, .015) << kind.name;
    EXPECT_GT(v.front(), 0) << kind.name;
    EXPECT_LT(v.back(), 1) << kind.name;
    EXPECT_LT(v[kPlaces / 20], .32f) << kind.name;
  }
}

TEST(Noise, EvenKindTakesAllValuesAboutAsOften) {
  for (const Kind& kind : kEven) {
    const std::vector<float> v = sorted_values(kind);
    double largest = 0;
    for (int i = 0; i < kPlaces; ++i)
      largest = std::max(largest, std::abs(v[static_cast<std::size_t>(i)] - (i + .5) / kPlaces));
    // The fit is within .002; places on a line share 6000 cells, which leaves as much again by
    // chance.
    EXPECT_LT(largest, .01) << kind.name;
  }
}

TEST(Noise, NeighboursAndLatticePointsAreNoRegularity) {
  // Plain gradient noise is the same at all whole coordinates, and repeats.
  int same = 0, repeated = 0;
  double product = 0;
  for (int i = 0; i < 1000; ++i) {
    const miVector here = {float(i), float(i % 7), 3}, next = {float(i + 1), float(i % 7), 3};
    const miVector far = {float(i + 256), float(i % 7), 3};
    same += std::abs(mi_noise_3d(&here) - .5f) < 1e-4f;
    repeated += mi_noise_3d(&here) == mi_noise_3d(&far);
    product += (mi_unoise_3d(&here) - .5) * (mi_unoise_3d(&next) - .5) * 12 / 1000;
  }
  EXPECT_LT(same, 5);
  EXPECT_LT(repeated, 3);
  EXPECT_NEAR(product, 0, .1);
}

TEST(Noise, GradientsAreThoseOfDifferences) {
  const float h = 1.0f / 64;
  for (int i = 0; i < 300; ++i) {
    miVector p = place(i);
    // Near the origin differences keep their digits.
    p.x /= 300, p.y /= 300, p.z /= 300;
    for (const bool even : {false, true}) {
      float g1, gx, gy;
      miVector g;
      const auto n1 = even ? mi_unoise_1d : mi_noise_1d;
      const auto n2 = even ? mi_unoise_2d : mi_noise_2d;
      const auto n3 = even ? mi_unoise_3d : mi_noise_3d;
      EXPECT_EQ((even ? mi_unoise_1d_grad : mi_noise_1d_grad)(p.x, &g1), n1(p.x));
      EXPECT_EQ((even ? mi_unoise_2d_grad : mi_noise_2d_grad)(p.x, p.y, &gx, &gy), n2(p.x, p.y));
      EXPECT_EQ((even ? mi_unoise_3d_grad : mi_noise_3d_grad)(&p, &g), n3(&p));
      // Fourth order, so that the step may be wide.
      const auto slope = [&](auto f) {
        return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
      };
      constexpr float kNear = .003f;
      EXPECT_NEAR(g1, slope([&](float d) { return n1(p.x + d); }), kNear);
      EXPECT_NEAR(gx, slope([&](float d) { return n2(p.x + d, p.y); }), kNear);
      EXPECT_NEAR(gy, slope([&](float d) { return n2(p.x, p.y + d); }), kNear);
      const auto moved = [&](float dx, float dy, float dz) {
        const miVector q = {p.x + dx, p.y + dy, p.z + dz};
        return n3(&q);
      };
      EXPECT_NEAR(g.x, slope([&](float d) { return moved(d, 0, 0); }), kNear);
      EXPECT_NEAR(g.y, slope([&](float d) { return moved(0, d, 0); }), kNear);
      EXPECT_NEAR(g.z, slope([&](float d) { return moved(0, 0, d); }), kNear);
    }
  }
}

TEST(Noise, IsTotal) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {nan, INFINITY, -INFINITY, 1e30f, -3e38f, 0x1p31f}) {
    const miVector p = {x, -x, 1};
    for (const float v : {mi_noise_1d(x), mi_noise_2d(1, x), mi_unoise_3d(&p)}) {
      EXPECT_GE(v, 0);
      EXPECT_LE(v, 1);
    }
  }
}

TEST(Noise, OfTheLatticeStaysWithinItsBound) {
  using oriel::sdk::lattice_noise;
  using oriel::sdk::noise_bound;
  for (int i = 0; i < kPlaces; ++i) {
    const miVector p = place(i);
    EXPECT_LE(std::abs(lattice_noise<1>({p.x}).value), noise_bound<1>());
    EXPECT_LE(std::abs(lattice_noise<2>({p.x, p.y}).value), noise_bound<2>());
    EXPECT_LE(std::abs(lattice_noise<3>({p.x, p.y, p.z}).value), noise_bound<3>());
  }
}

TEST(Spline, PassesItsPointsAndKeepsLines) {
  const miScalar points[5] = {1, 4, 2, 2, -3};
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(mi_spline(static_cast<float>(i) / 4, 5, points), points[i], 1e-5f);
  const miScalar line[4] = {1, 3, 5, 7};
  for (const float t : {0.0f, .1f, .5f, .77f, 1.0f})
    EXPECT_NEAR(mi_spline(t, 4, line), 1 + 6 * t, 1e-5f);
  EXPECT_NEAR(mi_spline(.25f, 2, line), 1.5f, 1e-6f);
  EXPECT_EQ(mi_spline(2, 4, line), 7);
}

TEST(Spline, IsCatmullAndRoms) {
  // Between b and c: (-a + 9 b + 9 c - d) / 16 in the middle.
  const miScalar points[4] = {1, 4, 2, 8};
  EXPECT_NEAR(mi_spline(.5f, 4, points), (-1 + 36 + 18 - 8) / 16.0f, 1e-5f);
}

}  // namespace noise_test
