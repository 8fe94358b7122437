// SPDX-License-Identifier: Apache-2.0
#include "bsdf/diffusion_profile.h"

#include <gtest/gtest.h>

namespace oriel::bsdf {
namespace diffusion_profile_test {

/// Share of the light within r, by quadrature of eval().
double within(const DiffusionProfile& profile, double r) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = r * (i + .5) / kSteps;
    sum += double{profile.eval(static_cast<float>(at))} * 2 * double{kPi} * at * r / kSteps;
  }
  return sum;
}

TEST(DiffusionProfile, IsNormalisedAtEveryRadius) {
  for (const float radius : {.01f, 1.0f, 40.0f}) {
    const DiffusionProfile profile(radius);
    EXPECT_NEAR(within(profile, double{radius}), 1, 1e-3);
    EXPECT_EQ(profile.eval(radius * 1.001f), 0);
  }
}

TEST(DiffusionProfile, IsThatOfThePaperBeforeTheCut) {
  // Ratios of values, where the normalisation cancels; d = 1.
  const DiffusionProfile profile(8);
  const auto paper = [](double r) { return (std::exp(-r) + std::exp(-r / 3)) / r; };
  for (const double r : {.1, .5, 2.0, 7.5})
    EXPECT_NEAR(double{profile.eval(static_cast<float>(r))} / double{profile.eval(1)},
                paper(r) / paper(1), 1e-4 * paper(r));
}

TEST(DiffusionProfile, SamplesHaveItsDensity) {
  const DiffusionProfile profile(2);
  for (const float u : {.05f, .2f, .24f, .3f, .6f, .95f, .999f}) {
    // The two parts of the mixture are sampled by separate ranges of u.
    constexpr int kSamples = 20000;
    const float r = profile.sample(u);
    int below = 0;
    for (int i = 0; i < kSamples; ++i)
      below += profile.sample((static_cast<float>(i) + .5f) / kSamples) <= r;
    EXPECT_NEAR(static_cast<double>(below) / kSamples, within(profile, double{r}), 2e-3) << u;
  }
  EXPECT_LE(profile.sample(.9999999f), 2);
}

}  // namespace diffusion_profile_test
}  // namespace oriel::bsdf
