// SPDX-License-Identifier: Apache-2.0
#include "bsdf/phase.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sampling/testing/chi_square.h"

namespace oriel::bsdf {
namespace phase_test {

TEST(SchlickPhase, IntegratesToOneAndLeansForward) {
  for (const float k : {-.9f, -.4f, 0.0f, .5f, .95f}) {
    double whole = 0, mean_cosine = 0;
    for (int i = 0; i < 20000; ++i) {
      const double c = -1 + (i + .5) / 10000;
      const double p = SchlickPhase(k).eval(static_cast<float>(c)) * 2 * M_PI / 10000;
      whole += p;
      mean_cosine += p * c;
    }
    EXPECT_NEAR(whole, 1, 1e-3) << k;
    EXPECT_GE(mean_cosine * k, 0) << k;
  }
  EXPECT_NEAR(SchlickPhase(0).eval(1), 1 / (4 * M_PI), 1e-6);
}

TEST(SchlickPhase, DirectionsMatchTheirDensity) {
  for (const float k : {-.7f, .3f, .9f}) {
    const SchlickPhase phase(k);
    const testing::DirectionTest test = testing::test_directions(
        [&](const Vec2& u, float) -> std::optional<Vec3> { return phase.sample(u); },
        [&](const Vec3& w) { return phase.eval(w.z); }, 40000, 22);
    EXPECT_NEAR(test.pdf_integral, 1, 2e-3) << k;
    EXPECT_GT(test.chi.p_value, testing::sidak(.01, 3)) << k;
  }
}

// The share of paths longer than x is exp(-extinction x): the inverse of the cumulative share.
TEST(FreePath, IsExponential) {
  for (const float u : {0.0f, .1f, .5f, .9f})
    EXPECT_NEAR(std::exp(-2.5 * sample_free_path(u, 2.5f)), 1 - u, 1e-6) << u;
}

}  // namespace phase_test
}  // namespace oriel::bsdf
