// SPDX-License-Identifier: Apache-2.0
#include "bsdf/terminator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace terminator_test {

using testing::polar_direction;

const Vec3 kUp(0, 0, 1);

TEST(Terminator, IsExactlyOneWhereTheNormalsAgree) {
  for (int i = 0; i < 2000; ++i) {
    sampling::Sampler sampler(i, 3, 0);
    const Vec3 n = sampling::sample_uniform_sphere(sampler.next_2d());
    const Vec3 wi = sampling::sample_uniform_sphere(sampler.next_2d());
    EXPECT_EQ(soft_terminator(n, n, wi), 1);
  }
}

TEST(Terminator, StaysBetweenZeroAndOne) {
  for (int i = 0; i < 20000; ++i) {
    sampling::Sampler sampler(i, 4, 0);
    const Vec3 ng = sampling::sample_uniform_sphere(sampler.next_2d());
    Vec3 ns = sampling::sample_uniform_sphere(sampler.next_2d());
    if (dot(ns, ng) < 0) ns = -ns;
    const Vec3 wi = sampling::sample_uniform_sphere(sampler.next_2d());
    const float f = soft_terminator(ng, ns, wi);
    EXPECT_GE(f, 0);
    EXPECT_LE(f, 1);
  }
}

TEST(Terminator, IsTheCubicOfTheRatioOfCosines) {
  // Normal tilted by 30 degrees, light at 80 on the same side: cos 80 / (cos 50 cos 30) = 0.311941.
  const float g = 0.311941f;
  EXPECT_NEAR(soft_terminator(kUp, polar_direction(30), polar_direction(80)),
              -g * g * g + g * g + g, 1e-5f);
  // On the other side of the geometric normal the shading normal has a smaller cosine: no
  // softening.
  EXPECT_EQ(soft_terminator(kUp, polar_direction(30), polar_direction(-40)), 1);
}

TEST(Terminator, FallsContinuouslyToZeroAtTheGeometricHorizon) {
  for (const float tilt : {2.0f, 20.0f, 60.0f}) {
    const Vec3 ns = polar_direction(tilt);
    constexpr float kStep = 0.01f;  // degrees
    float before = soft_terminator(kUp, ns, polar_direction(0));
    float most = 0;
    for (float angle = kStep; angle < 95; angle += kStep) {
      const float f = soft_terminator(kUp, ns, polar_direction(angle));
      EXPECT_LE(f, before + 1e-5f) << tilt << ' ' << angle;
      most = std::max(most, std::abs(f - before));
      before = f;
    }
    // The slope in cosines is at most 4/3 divided by the smallest shading cosine.
    const float least = dot(ns, polar_direction(90)) * dot(kUp, ns);
    EXPECT_LE(most, 4.0f / 3 * kStep * kPi / 180 / least * 1.1f + 1e-5f) << tilt;
    EXPECT_LT(soft_terminator(kUp, ns, polar_direction(89.99f)), 0.01f) << tilt;
    EXPECT_EQ(soft_terminator(kUp, ns, polar_direction(90.01f)), 0) << tilt;
  }
}

}  // namespace terminator_test
}  // namespace oriel::bsdf
