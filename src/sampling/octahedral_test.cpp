// SPDX-License-Identifier: Apache-2.0
#include "sampling/octahedral.h"

#include <gtest/gtest.h>

#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel::sampling {
namespace octahedral_test {

TEST(Octahedral, DirectionsReturn) {
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const Vec3 d = sample_uniform_sphere(Sampler(3, 4, i).next_2d());
    const Vec2 uv = octahedral_uv(d);
    ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
    ASSERT_GT(dot(octahedral_direction(uv), d), 1 - 1e-6f);
  }
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    for (const float sign : {1.0f, -1.0f})
      EXPECT_GT(dot(octahedral_direction(octahedral_uv(axis * sign)), axis * sign), 1 - 1e-6f);
}

TEST(Octahedral, SolidAngleIsThatOfSmallSquares) {
  constexpr float kStep = 1e-3f;
  double sum = 0;
  constexpr int kSteps = 50;
  for (int k = 0; k < kSteps * kSteps; ++k) {
    const float u = (static_cast<float>(k % kSteps) + .5f) / kSteps;
    const float v = (static_cast<float>(k / kSteps) + .5f) / kSteps;
    const Vec3 d = octahedral_direction(Vec2(u, v));
    const Vec3 along_u =
        octahedral_direction(Vec2(u + kStep, v)) - octahedral_direction(Vec2(u - kStep, v));
    const Vec3 along_v =
        octahedral_direction(Vec2(u, v + kStep)) - octahedral_direction(Vec2(u, v - kStep));
    const float expected = length(cross(along_u, along_v)) / (4 * kStep * kStep);
    const Vec2 fold(std::abs(2 * u - 1), std::abs(2 * v - 1));
    // The folds have a corner of the mapping within the step.
    if (std::abs(fold.x + fold.y - 1) > 4 * kStep && fold.x > 4 * kStep && fold.y > 4 * kStep) {
      EXPECT_NEAR(octahedral_solid_angle(d), expected, 2e-3f * expected) << u << " " << v;
    }
    sum += static_cast<double>(octahedral_solid_angle(d));
  }
  EXPECT_NEAR(sum / (kSteps * kSteps), 4 * kPi, 0.01);
}

}  // namespace octahedral_test
}  // namespace oriel::sampling
