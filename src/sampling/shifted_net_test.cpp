// SPDX-License-Identifier: Apache-2.0
#include "sampling/shifted_net.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace oriel::sampling {
namespace shifted_net_test {

// 64 points of a net have one in each of 8 x 8 cells; shifted by whole cells they still do.
TEST(ShiftedNet, CoversTheSquareEvenly) {
  const auto shift = [] { return Vec2(.375f, .625f); };
  ShiftedNet net;
  net.start(2, shift);
  int hits[64] = {};
  for (int i = 0; i < 64; ++i) {
    double u[2];
    net.fill(u, 2, i, shift);
    ASSERT_TRUE(u[0] >= 0 && u[0] < 1 && u[1] >= 0 && u[1] < 1);
    ++hits[static_cast<int>(u[0] * 8) * 8 + static_cast<int>(u[1] * 8)];
  }
  for (const int n : hits) EXPECT_EQ(n, 1);
}

TEST(ShiftedNet, FurtherPairsAreDrawn) {
  ShiftedNet net;
  net.start(11, [] { return Vec2(0, 0); });
  double u[12] = {};
  u[11] = -1;
  net.fill(u, 11, 3, [] { return Vec2(.25f, .75f); });
  EXPECT_EQ(u[8], .25);
  EXPECT_EQ(u[9], .75);
  EXPECT_EQ(u[10], .25);
  EXPECT_EQ(u[11], -1) << "not a coordinate";
}

TEST(Erand48, IsThatOfPosix) {
  unsigned short ours[3] = {1, 2, 3}, theirs[3] = {1, 2, 3};
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(erand48(ours), ::erand48(theirs), 1e-7);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(ours[k], theirs[k]);
}

}  // namespace shifted_net_test
}  // namespace oriel::sampling
