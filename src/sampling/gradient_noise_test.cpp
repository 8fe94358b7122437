// SPDX-License-Identifier: Apache-2.0
#include "sampling/gradient_noise.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel::sampling {
namespace gradient_noise_test {

TEST(GradientNoise, MatchesThePublishedFunction) {
  // The value that implementations of the 2002 reference code return.
  EXPECT_NEAR(gradient_noise(Vec3(3.14f, 42, 7)), 0.13691995878400012, 1e-5);
}

TEST(GradientNoise, IsZeroOnTheLatticeAndBounded) {
  float least = 0, most = 0;
  double sum = 0;
  int count = 0;
  for (int x = -8; x < 8; ++x)
    for (int y = -8; y < 8; ++y)
      for (int z = -8; z < 8; ++z) {
        const Vec3 p(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        EXPECT_EQ(gradient_noise(p), 0);
        for (int k = 1; k < 8; ++k, ++count) {
          const auto t = static_cast<float>(k) / 8;
          const float n = gradient_noise(p + Vec3(t, 1 - t * t, 0.5f * t + 0.3f));
          least = std::min(least, n);
          most = std::max(most, n);
          sum += n;
        }
      }
  EXPECT_GE(least, -1);
  EXPECT_LE(most, 1);
  EXPECT_LT(least, -0.4f);
  EXPECT_GT(most, 0.4f);
  EXPECT_NEAR(sum / count, 0, 0.01);
}

TEST(GradientNoise, RepeatsAfter256AndIsTotal) {
  const Vec3 p(1.25f, 2.5f, 3.75f);
  EXPECT_EQ(gradient_noise(p), gradient_noise(p + Vec3(256, -256, 512)));
  EXPECT_TRUE(std::isfinite(gradient_noise(Vec3(1e30f, -1e30f, 1e20f))));
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(gradient_noise(Vec3(none, 0, 0)), 0);
}

}  // namespace gradient_noise_test
}  // namespace oriel::sampling
