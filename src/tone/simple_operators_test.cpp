// SPDX-License-Identifier: Apache-2.0
#include "tone/simple_operators.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel::tone {
namespace simple_operators_test {

TEST(SimpleOperators, DesaturationKeepsTheMeanAndBoundsTheLargest) {
  const Rgb c = desaturate_to_one(Rgb(1.5f, .3f, .6f));
  EXPECT_NEAR(c.x, 1, 1e-6f);
  EXPECT_NEAR((c.x + c.y + c.z) / 3, .8f, 1e-6f);
  // Differences to the mean shrink alike: .2 / .7 of them.
  EXPECT_NEAR(c.y, .8f - .5f * .2f / .7f, 1e-6f);
  EXPECT_EQ(desaturate_to_one(Rgb(.2f, 1, .1f)), Rgb(.2f, 1, .1f));
  EXPECT_EQ(desaturate_to_one(Rgb(9, 1, 1)), Rgb(1));
}

TEST(SimpleOperators, ReinhardsCurve) {
  EXPECT_FLOAT_EQ(reinhard(1, 1, 1), .5f);
  EXPECT_FLOAT_EQ(reinhard(1.5f, 2, 1), .75f);
  EXPECT_FLOAT_EQ(reinhard(1, 1, 2), std::sqrt(.5f));
  EXPECT_FLOAT_EQ(reinhard(1, 1, 0), .5f);
  EXPECT_EQ(reinhard(-1, 1, 1), 0);
  EXPECT_EQ(reinhard(std::numeric_limits<float>::infinity(), 1, 1), 1);
  EXPECT_EQ(reinhard(std::numeric_limits<float>::quiet_NaN(), 1, 1), 0);
}

}  // namespace simple_operators_test
}  // namespace oriel::tone
