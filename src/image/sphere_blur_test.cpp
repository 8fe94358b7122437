// SPDX-License-Identifier: Apache-2.0
// Compares blurred lookups with kernels of known closed form.
#include "image/sphere_blur.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "base/frame.h"

namespace oriel::image {
namespace sphere_blur_test {

/// Evenly distributed directions on the sphere.
Vec3 spread(int i, int n) {
  const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
  const float r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2.399963f * static_cast<float>(i);
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

TEST(SphereBlur, KeepsConstantsAndMeansWithOneEvaluation) {
  std::atomic<int> asked{0};
  const SphereBlur even(10000, [&](const Vec3&) {
    ++asked;
    return Rgba(.3f, .2f, .1f, 1);
  });
  EXPECT_EQ(even.side(), 48);
  EXPECT_EQ(asked, 4 * 6 * 50 * 50);
  const SphereBlur spot(4096, [](const Vec3& d) {
    return dot(d, normalize(Vec3(.3f, .8f, -.4f))) > .99f ? Rgba(100, 1, 0, 1) : Rgba(0);
  });
  Rgba mean(0);
  for (int i = 0; i < 20000; ++i) {
    SphereBlur::Weights w{};
    w[0] = 1;
    mean += spot.lookup(spread(i, 20000), w) / 20000.0f;
  }
  EXPECT_NEAR(mean.r, 100 * .005f, .05f);
  for (std::size_t j = 0; j < SphereBlur::kLevels; ++j) {
    SphereBlur::Weights w{};
    w[j] = 1;
    Rgba blurred(0);
    for (int i = 0; i < 20000; ++i) {
      EXPECT_NEAR(even.lookup(spread(i, 20000), w).r, .3f, 1e-6f);
      blurred += spot.lookup(spread(i, 20000), w) / 20000.0f;
    }
    EXPECT_NEAR(blurred.r, mean.r, .005f * mean.r) << j;
  }
}

TEST(SphereBlur, LevelsHaveTheirNominalWidth) {
  // A round spot of the same kernel type: squared widths add up, except at the widest levels.
  for (const Vec3& to :
       {Vec3(0, 0, 1), normalize(Vec3(.3f, .8f, -.4f)), normalize(Vec3(1, 1, 0))}) {
    const float width = .06f;
    const SphereBlur blur(
        25600, [&](const Vec3& d) { return Rgba(std::exp((dot(d, to) - 1) / sqr(width))); });
    for (int j = 0; j < 6; ++j) {
      SphereBlur::Weights w{};
      w[static_cast<std::size_t>(j)] = 1;
      const float own = sqr(width), sum = own + sqr(blur.width(j));
      for (const float off : {0.0f, 1.0f, 2.0f}) {
        const float angle = off * std::sqrt(sum);
        const Frame frame(to);
        const Vec3 d = to * std::cos(angle) + frame.s * std::sin(angle);
        const float exact = own / sum * std::exp((std::cos(angle) - 1) / sum);
        EXPECT_NEAR(blur.lookup(d, w).r, exact, 0.04f * own / sum) << j << " at " << off;
      }
    }
  }
}

}  // namespace sphere_blur_test
}  // namespace oriel::image
