// SPDX-License-Identifier: Apache-2.0
#include "geom/barycentric.h"

#include <gtest/gtest.h>

namespace oriel::geom {
namespace barycentric_test {

const Vec3 kA(1, 0, 2), kB(3, 1, 2), kC(0, 4, 3);

TEST(Barycentric, WeightsGiveThePointOfThePlane) {
  for (const Vec3& w : {Vec3(.2f, .3f, .5f), Vec3(-.5f, 1, .5f), Vec3(0, 0, 1)}) {
    const Vec3 off = normalize(cross(kB - kA, kC - kA)) * 2.0f;
    const Vec3 found = barycentric_weights(kA * w.x + kB * w.y + kC * w.z + off, kA, kB, kC);
    EXPECT_LT(length(found - w), 1e-6f);
  }
}

TEST(Barycentric, DegenerateTrianglesGiveTheFirstCorner) {
  EXPECT_EQ(barycentric_weights(Vec3(7, 8, 9), kA, kB, kB), Vec3(1, 0, 0));
}

}  // namespace barycentric_test
}  // namespace oriel::geom
