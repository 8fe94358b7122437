// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "oriel/sdk/shader/sample.h"
#include "sampling/lattice_noise.h"

namespace oriel::sdk {
namespace noise_test {

using sampling::NoiseShape;
using sampling::shaped_noise;

// The other functions of each shape return a subset of these results.
TEST(Noise, FunctionsReturnTheirShapeAndItsGradient) {
  const miVector p = {1.3f, -2.6f, 7.9f};
  float g1, gx, gy;
  miVector g;
  for (const bool even : {false, true}) {
    const NoiseShape shape = even ? NoiseShape::Even : NoiseShape::Bell;
    const auto line = shaped_noise<1>({p.x}, shape);
    const auto plane = shaped_noise<2>({p.x, p.y}, shape);
    const auto space = shaped_noise<3>({p.x, p.y, p.z}, shape);
    EXPECT_EQ((even ? mi_unoise_1d : mi_noise_1d)(p.x), line.value);
    EXPECT_EQ((even ? mi_unoise_2d : mi_noise_2d)(p.x, p.y), plane.value);
    EXPECT_EQ((even ? mi_unoise_3d : mi_noise_3d)(&p), space.value);
    EXPECT_EQ((even ? mi_unoise_1d_grad : mi_noise_1d_grad)(p.x, &g1), line.value);
    EXPECT_EQ((even ? mi_unoise_2d_grad : mi_noise_2d_grad)(p.x, p.y, &gx, &gy), plane.value);
    EXPECT_EQ((even ? mi_unoise_3d_grad : mi_noise_3d_grad)(&p, &g), space.value);
    EXPECT_EQ(g1, line.slope[0]);
    EXPECT_EQ(Vec2(gx, gy), Vec2(plane.slope[0], plane.slope[1]));
    EXPECT_EQ(Vec3(g.x, g.y, g.z), Vec3(space.slope[0], space.slope[1], space.slope[2]));
  }
}

TEST(Spline, IsDefinedForAllInputs) {
  const miScalar points[4] = {1, 3, 5, 7};
  EXPECT_EQ(mi_spline(.5f, 4, points), 4);
  EXPECT_EQ(mi_spline(.5f, -1, points), 0);
  EXPECT_EQ(mi_spline(std::numeric_limits<float>::quiet_NaN(), 4, points), 1);
}

}  // namespace noise_test
}  // namespace oriel::sdk
