// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/gloss.h"
#include "bsdf/rough_refraction.h"
#include "bsdf/specular.h"
#include "sampling/sampler.h"
#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace refraction_test {

using testing::polar_direction;

using sampling::Sampler;

TEST(Refraction, FollowsSnell) {
  for (const float eta : {1.5f, 1.33f, 1.33f / 1.5f, 1 / 1.5f})
    for (double theta = 0; theta < 40; theta += 3) {
      const Vec3 wo = polar_direction(theta, 25);
      const auto s = ClearRefraction{eta}.sample(wo, {}, 0);
      ASSERT_TRUE(s && s->delta);
      EXPECT_EQ(s->weight, 1);
      EXPECT_LT(s->wi.z, 0);
      EXPECT_NEAR(length(s->wi), 1, 1e-6);
      EXPECT_NEAR(std::hypot(s->wi.x, s->wi.y) * eta, std::sin(theta * M_PI / 180), 1e-6);
      EXPECT_NEAR(s->wi.x * wo.y, s->wi.y * wo.x, 1e-6);
      EXPECT_LE(s->wi.x * wo.x, 0);
    }
}

TEST(Refraction, TotalReflectionBeginsAtTheCriticalAngle) {
  const Vec3 n(0, 0, 1);
  EXPECT_TRUE(refract(polar_direction(41.80, 25), n, 1 / 1.5f));
  EXPECT_FALSE(refract(polar_direction(41.82, 25), n, 1 / 1.5f));
  EXPECT_TRUE(refract(polar_direction(89.9, 25), n, 1.5f));
  const auto s = ClearRefraction{1 / 1.5f}.sample(polar_direction(60, 25), {}, 0);
  EXPECT_GT(s->wi.z, 0);
  EXPECT_TRUE(s->delta);
}

TEST(Refraction, ThinSheetDoesNotBend) {
  const Vec3 wo = polar_direction(70, 25);
  const auto s = ClearThinTransmission{}.sample(wo, {}, 0);
  EXPECT_EQ(s->wi, -wo);
  EXPECT_TRUE(s->delta);
}

TEST(RoughRefraction, TendsToTheClearOne) {
  for (const float eta : {1.5f, 1 / 1.5f}) {
    const RoughRefraction lobe(kMinAlpha, kMinAlpha, eta);
    const Vec3 wo = polar_direction(30, 25);
    const Vec3 clear = *refract(wo, Vec3(0, 0, 1), eta);
    double mean = 0;
    for (std::uint32_t i = 0; i < 1024; ++i)
      mean += dot(lobe.sample(wo, Sampler(0, 0, i).next_2d(), 0)->wi, clear) / 1024;
    EXPECT_GT(mean, 1 - 1e-4);
  }
}

// The density integrates to 1 by quadrature of its own formula.
TEST(RoughRefraction, FurnaceIsWhite) {
  for (const float eta : {1.5f, 1.1f, 1 / 1.33f, 1 / 1.5f, 2.4f})
    for (const auto& r : {Roughness{0.3f, 0.3f}, Roughness{0.6f, 0.15f}, Roughness{1, 1}})
      for (const double theta : {0.0, 40.0, 75.0, 87.0}) {
        const RoughRefraction lobe(r.ax, r.ay, eta);
        const Vec3 wo = polar_direction(theta, 25);
        double sum = 0;
        // |cos| = 1 - t^2 resolves the pole, where lobes are narrow for indices near 1.
        for (const double side : {-1.0, 1.0})
          for (int cell = 0; cell < 64; ++cell) {
            const double t0 = (cell / 8) / 8.0, p0 = (cell % 8) * M_PI / 4;
            sum += testing::integrate(
                [&](double t, double phi) {
                  const double z = side * (1 - t * t), s = std::sqrt(1 - z * z);
                  return 2 * t *
                         lobe.eval(wo, Vec3(static_cast<float>(s * std::cos(phi)),
                                            static_cast<float>(s * std::sin(phi)),
                                            static_cast<float>(z)));
                },
                t0, t0 + 0.125, p0, p0 + M_PI / 4, 1e-5, 6);
          }
        EXPECT_NEAR(sum, 1, 0.005) << "eta " << eta << " ax " << r.ax << " theta " << theta;
      }
}

// acceptance: T3
TEST(RoughRefraction, SpreadFallsWithGloss) {
  for (const float eta : {1.5f, 1 / 1.5f}) {
    double last = 2;
    for (float gloss = 0; gloss < 1; gloss += 0.1f) {
      const Roughness r = gloss_to_roughness(gloss);
      const RoughRefraction lobe(r.ax, r.ay, eta);
      Vec3 mean(0, 0, 0);
      for (std::uint32_t i = 0; i < 4096; ++i)
        mean +=
            lobe.sample(polar_direction(20, 25), Sampler(0, 0, i).next_2d(), 0)->wi * (1.0f / 4096);
      const double spread = 1 - length(mean);  // circular variance
      EXPECT_LT(spread, last);
      last = spread;
    }
  }
}

// acceptance: T3
TEST(RoughRefraction, IsAsWideAsASheetWhateverTheIndex) {
  const auto spread = [](const auto& lobe, const Vec3& wo) {
    Vec3 mean(0, 0, 0);
    for (std::uint32_t i = 0; i < 16384; ++i)
      if (const auto s = lobe.sample(wo, Sampler(0, 0, i).next_2d(), 0))
        mean += s->wi * (s->weight / 16384);
    return 1 - length(mean);
  };
  for (const float gloss : {0.0f, 0.3f, 0.6f}) {
    const Roughness r = gloss_to_roughness(gloss);
    const double sheet = spread(RoughThinTransmission(r.ax, r.ay), polar_direction(0, 25));
    EXPECT_GT(sheet, gloss == 0 ? 0.15 : 0.001);
    for (const float eta : {1.0f, 1.0001f, 1.2f, 1.5f, 2.4f, 1 / 1.5f})
      EXPECT_NEAR(spread(RoughRefraction(r.ax, r.ay, eta), polar_direction(0, 25)) / sheet, 1, 0.02)
          << eta << ' ' << gloss;
  }
}

TEST(RoughRefraction, OfEqualIndicesIsTheSheets) {
  const Vec3 wo = polar_direction(50, 25), wi = -polar_direction(40, 60);
  EXPECT_NEAR(RoughRefraction(0.3f, 0.1f, 1).eval(wo, wi),
              RoughThinTransmission(0.3f, 0.1f).eval(wo, wi), 1e-6);
}

}  // namespace refraction_test
}  // namespace oriel::bsdf
