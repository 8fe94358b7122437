// SPDX-License-Identifier: Apache-2.0
#include "image/rgbe.h"

#include <gtest/gtest.h>

namespace oriel {
namespace rgbe_test {

// 1 = .5 * 2^1 and half of 256 is 128; .25 is a quarter of that.
TEST(RgbeTest, EncodesMantissasAndTheirExponent) {
  EXPECT_EQ(encode_rgbe(Rgb(1, .25f, 0)), (Rgbe{128, 32, 0, 129}));
  EXPECT_EQ(encode_rgbe(Rgb(-1, 0, 0)), (Rgbe{0, 0, 0, 0}));
  EXPECT_EQ(decode_rgbe({0, 0, 0, 0}), Rgb(0));
}

TEST(RgbeTest, ComesBackWithinAStepOfTheLargest) {
  for (const float scale : {1e-30f, .01f, 1.0f, 500.0f, 1e30f}) {
    const Rgb c = Rgb(.9f, .4f, .05f) * scale, back = decode_rgbe(encode_rgbe(c));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], c[k], scale / 256) << scale << ' ' << k;
  }
}

}  // namespace rgbe_test
}  // namespace oriel
