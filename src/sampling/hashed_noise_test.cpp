// SPDX-License-Identifier: Apache-2.0
#include "sampling/hashed_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sampling/lattice_hash.h"

namespace oriel::sampling {
namespace hashed_noise_test {

// White noise of Blender 3.4 at these places, rendered by Cycles.
TEST(LatticeHash, ColorsAreThoseOfBlender) {
  const float x = .31f * 5, y = .62f * 5, z = .17f * 5;
  const float solid[] = {x, y, z}, all[] = {x, y, z, 2};
  const std::array<float, 3> three = {.582039f, .806313f, .530507f},
                             four = {.530507f, .868046f, .216488f};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(position_color(solid)[i], three[i], 1e-6f);
    EXPECT_NEAR(position_color(all)[i], four[i], 1e-6f);
  }
}

TEST(LatticeHash, DiffersByEveryBitAndByTheNumberOfWords) {
  const std::uint32_t key[] = {7, 7, 7, 7};
  std::vector<std::uint32_t> found;
  for (std::size_t n = 1; n <= 4; ++n) {
    found.push_back(lattice_hash({key, n}));
    for (std::size_t word = 0; word < n; ++word)
      for (int bit = 0; bit < 32; ++bit) {
        std::uint32_t changed[] = {7, 7, 7, 7};
        changed[word] ^= 1u << bit;
        found.push_back(lattice_hash({changed, n}));
      }
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
}

TEST(LatticeHash, MatchesThePublishedFunction) {
  // hashword() of lookup3.c with the initial value 13, by an independent implementation.
  const std::uint32_t key[] = {1, 2, 3, 4};
  EXPECT_EQ(lattice_hash({key, 1}), 1255655072u);
  EXPECT_EQ(lattice_hash({key, 2}), 272092061u);
  EXPECT_EQ(lattice_hash({key, 3}), 3100736010u);
  EXPECT_EQ(lattice_hash({key, 4}), 92593857u);
}

TEST(HashedNoise, IsZeroOnTheLatticeAndHasItsRange) {
  for (std::size_t n = 1; n <= 4; ++n) {
    float least = 0, most = 0;
    double sum = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      float at[4], whole[4];
      for (std::size_t k = 0; k < n; ++k) {
        const auto step = static_cast<float>(i) * (0.613f + 0.271f * static_cast<float>(k));
        at[k] = step - 900;
        whole[k] = std::floor(at[k]);
      }
      EXPECT_EQ(hashed_noise({whole, n}), 0);
      const float value = hashed_noise({at, n});
      least = std::min(least, value);
      most = std::max(most, value);
      sum += value;
    }
    EXPECT_GE(least, -1.05f) << n;
    EXPECT_LE(most, 1.05f) << n;
    EXPECT_LT(least, -0.6f) << n;
    EXPECT_GT(most, 0.6f) << n;
    EXPECT_NEAR(sum / count, 0, 0.02) << n;
  }
}

TEST(HashedNoise, IsContinuousAndTotal) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const float far : {none, 1e30f, -1e30f, std::numeric_limits<float>::infinity()}) {
    const float at[] = {0.5f, far, 0.5f};
    EXPECT_EQ(hashed_noise(at), 0);
  }
  for (float x = -2; x < 2; x += 0.25f) {
    const float at[] = {x, 0.3f, -0.7f}, before[] = {x - 1e-4f, 0.3f, -0.7f};
    EXPECT_NEAR(hashed_noise(at), hashed_noise(before), 2e-3f);
  }
}

}  // namespace hashed_noise_test
}  // namespace oriel::sampling
