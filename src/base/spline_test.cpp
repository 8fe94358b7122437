// SPDX-License-Identifier: Apache-2.0
#include "base/spline.h"

#include <gtest/gtest.h>

#include <array>

namespace oriel {
namespace spline_test {

TEST(Spline, InterpolatesPointsAndReproducesLines) {
  constexpr std::array<float, 5> kPoints = {1, 4, 2, 2, -3};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(catmull_rom(static_cast<float>(i) / 4, kPoints), kPoints[i], 1e-5f);
  constexpr std::array<float, 4> kLine = {1, 3, 5, 7};
  for (const float t : {0.0f, .1f, .5f, .77f, 1.0f})
    EXPECT_NEAR(catmull_rom(t, kLine), 1 + 6 * t, 1e-5f);
  EXPECT_NEAR(catmull_rom(.25f, std::span(kLine).first(2)), 1.5f, 1e-6f);
  EXPECT_EQ(catmull_rom(2, kLine), 7);
  EXPECT_EQ(catmull_rom(.5f, std::span(kLine).first(1)), 1);
  EXPECT_EQ(catmull_rom(.5f, {}), 0);
}

TEST(Spline, MatchesCatmullRom) {
  // Between b and c: (-a + 9 b + 9 c - d) / 16 in the middle.
  constexpr std::array<float, 4> kPoints = {1, 4, 2, 8};
  EXPECT_NEAR(catmull_rom(.5f, kPoints), (-1 + 36 + 18 - 8) / 16.0f, 1e-5f);
}

}  // namespace spline_test
}  // namespace oriel
