// SPDX-License-Identifier: Apache-2.0
#include "sampling/lattice_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sampling/sampler.h"

namespace oriel::sampling {
namespace lattice_noise_test {

constexpr int kPlaces = 100000;

/// Places up to 3000 units from the origin.
Vec3 place(int i) {
  Sampler s(i, 0, 0, 5);
  const Vec2 u = s.next_2d();
  return {6000 * u.x - 3000, 6000 * u.y - 3000, 6000 * s.next_1d() - 3000};
}

float noise_1d(const Vec3& p, NoiseShape shape) { return shaped_noise<1>({p.x}, shape).value; }
float noise_2d(const Vec3& p, NoiseShape shape) { return shaped_noise<2>({p.x, p.y}, shape).value; }
float noise_3d(const Vec3& p, NoiseShape shape) {
  return shaped_noise<3>({p.x, p.y, p.z}, shape).value;
}
using Noise = float (*)(const Vec3&, NoiseShape);
constexpr Noise kNoises[] = {noise_1d, noise_2d, noise_3d};

std::vector<float> sorted_values(Noise noise, NoiseShape shape) {
  std::vector<float> values(kPlaces);
  for (int i = 0; i < kPlaces; ++i) values[static_cast<std::size_t>(i)] = noise(place(i), shape);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(ShapedNoise, IsABellAboutOneHalfWithinZeroAndOne) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<float> v = sorted_values(kNoises[d], NoiseShape::Bell);
    double mean = 0, square = 0;
    for (const float x : v) mean += x / kPlaces, square += (x - .5) * (x - .5) / kPlaces;
    EXPECT_NEAR(mean, .5, .003) << d + 1;
    EXPECT_NEAR(std::sqrt(square), .14, .015) << d + 1;
    EXPECT_GT(v.front(), 0) << d + 1;
    EXPECT_LT(v.back(), 1) << d + 1;
    EXPECT_LT(v[kPlaces / 20], .32f) << d + 1;
  }
}

TEST(ShapedNoise, EvenKindTakesAllValuesAboutAsOften) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<float> v = sorted_values(kNoises[d], NoiseShape::Even);
    double largest = 0;
    for (int i = 0; i < kPlaces; ++i)
      largest = std::max(largest, std::abs(v[static_cast<std::size_t>(i)] - (i + .5) / kPlaces));
    // The fit is within .002; points on a line share 6000 cells, which adds a random error of the
    // same size.
    EXPECT_LT(largest, .01) << d + 1;
  }
}

TEST(ShapedNoise, NeighboursAndLatticePointsAreNoRegularity) {
  // Plain gradient noise is equal at all integer coordinates, and periodic.
  int same = 0, repeated = 0;
  double product = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 here = {float(i), float(i % 7), 3}, next = {float(i + 1), float(i % 7), 3};
    const Vec3 far = {float(i + 256), float(i % 7), 3};
    same += std::abs(noise_3d(here, NoiseShape::Bell) - .5f) < 1e-4f;
    repeated += noise_3d(here, NoiseShape::Bell) == noise_3d(far, NoiseShape::Bell);
    product += (noise_3d(here, NoiseShape::Even) - .5) * (noise_3d(next, NoiseShape::Even) - .5) *
               12 / 1000;
  }
  EXPECT_LT(same, 5);
  EXPECT_LT(repeated, 3);
  EXPECT_NEAR(product, 0, .1);
}

TEST(ShapedNoise, GradientsAreThoseOfDifferences) {
  const float h = 1.0f / 64;
  for (int i = 0; i < 300; ++i) {
    Vec3 p = place(i);
    // Close to the origin differences are accurate.
    p.x /= 300, p.y /= 300, p.z /= 300;
    for (const NoiseShape shape : {NoiseShape::Bell, NoiseShape::Even}) {
      // Fourth order, which allows a large step.
      const auto slope = [&](Noise noise, const Vec3& axis) {
        const auto f = [&](float d) { return noise(p + axis * d, shape); };
        return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
      };
      constexpr float kNear = .003f;
      const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
      const auto g1 = shaped_noise<1>({p.x}, shape).slope;
      const auto g2 = shaped_noise<2>({p.x, p.y}, shape).slope;
      const auto g3 = shaped_noise<3>({p.x, p.y, p.z}, shape).slope;
      EXPECT_NEAR(g1[0], slope(noise_1d, x), kNear);
      EXPECT_NEAR(g2[0], slope(noise_2d, x), kNear);
      EXPECT_NEAR(g2[1], slope(noise_2d, y), kNear);
      EXPECT_NEAR(g3[0], slope(noise_3d, x), kNear);
      EXPECT_NEAR(g3[1], slope(noise_3d, y), kNear);
      EXPECT_NEAR(g3[2], slope(noise_3d, z), kNear);
    }
  }
}

TEST(ShapedNoise, IsTotal) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {nan, INFINITY, -INFINITY, 1e30f, -3e38f, 0x1p31f}) {
    const Vec3 p = {x, -x, 1};
    for (const float v : {noise_1d(p, NoiseShape::Bell), noise_2d(Vec3(1, x, 0), NoiseShape::Bell),
                          noise_3d(p, NoiseShape::Even)}) {
      EXPECT_GE(v, 0);
      EXPECT_LE(v, 1);
    }
  }
}

TEST(LatticeNoise, StaysWithinItsBound) {
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 p = place(i);
    EXPECT_LE(std::abs(lattice_noise<1>({p.x}).value), noise_bound<1>());
    EXPECT_LE(std::abs(lattice_noise<2>({p.x, p.y}).value), noise_bound<2>());
    EXPECT_LE(std::abs(lattice_noise<3>({p.x, p.y, p.z}).value), noise_bound<3>());
  }
}

}  // namespace lattice_noise_test
}  // namespace oriel::sampling
