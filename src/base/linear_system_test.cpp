// SPDX-License-Identifier: Apache-2.0
#include "base/linear_system.h"

#include <gtest/gtest.h>

#include <array>

namespace oriel {
namespace linear_system_test {

using Rows = std::array<float, 16>;
constexpr Rows kPlaced = {2, 0, 0, 0, 0, .5f, .25f, 0, .5f, -1, 3, 0, 7, -2, 1, 1};

TEST(LinearSystem, SolutionSatisfiesTheEquations) {
  // More columns than are solved together.
  constexpr int kColumns = 18;
  std::array<float, 4 * kColumns> right, x;
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = static_cast<float>(i % 7) - 3;
  ASSERT_TRUE(solve_linear_system(kPlaced, right.data(), kColumns, x.data()));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < kColumns; ++j) {
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += kPlaced[4 * i + k] * x[k * kColumns + j];
      EXPECT_NEAR(sum, right[i * kColumns + j], 1e-5f) << i << ' ' << j;
    }
}

TEST(LinearSystem, SmallScalesBesideDistantTranslationsAreNotSingular) {
  const Rows m = {1e-6f, 0, 0, 0, 0, 1e-6f, 0, 0, 0, 0, 1e-6f, 0, 1e6f, 0, 0, 1};
  Rows inverse;
  ASSERT_TRUE(invert_exactly(m, inverse.data()));
  EXPECT_NEAR(inverse[0], 1e6f, 1);
  const Rows flat = {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1};
  EXPECT_FALSE(invert_exactly(flat, inverse.data()));
}

TEST(LinearSystem, RotationsAreRightHanded) {
  const Mat4 quarter = rotation_about(Vec3(0, 0, 1), kPi / 2);
  EXPECT_LT(length(transform_vector(Vec3(1, 0, 0), quarter) - Vec3(0, 1, 0)), 1e-6f);
  EXPECT_EQ(rotation_about(Vec3(0), 1), Mat4());
}

}  // namespace linear_system_test
}  // namespace oriel
