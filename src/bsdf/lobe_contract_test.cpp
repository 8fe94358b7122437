// SPDX-License-Identifier: Apache-2.0
// The contract of lobes, tested for each lobe: density, weight, sign, energy.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "bsdf/burley_diffuse.h"
#include "bsdf/facet_reflection.h"
#include "bsdf/glossy_reflection.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/rough_refraction.h"
#include "bsdf/sheen.h"
#include "bsdf/specular.h"
#include "bsdf/translucency.h"
#include "sampling/sampler.h"
#include "sampling/testing/chi_square.h"

namespace oriel::bsdf {
namespace lobe_contract_test {

using sampling::Sampler;

struct Case {
  std::string name;
  bool always_samples;  ///< no sample is lost, so the density integrates to 1
  bool reciprocal;      ///< eval(a, b) / cos b == eval(b, a) / cos a
  std::function<float(const Vec3&, const Vec3&)> eval, pdf;
  std::function<std::optional<LobeSample>(const Vec3&, const Vec2&, float)> sample;

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

template <typename Lobe>
Case make(std::string name, const Lobe& lobe, bool always_samples, bool reciprocal) {
  return {std::move(name),
          always_samples,
          reciprocal,
          [lobe](const Vec3& o, const Vec3& i) { return lobe.eval(o, i); },
          [lobe](const Vec3& o, const Vec3& i) { return lobe.pdf(o, i); },
          [lobe](const Vec3& o, const Vec2& u2, float u1) { return lobe.sample(o, u2, u1); }};
}

std::vector<Case> cases() {
  return {
      make("Lambert", OrenNayar(0), true, true),
      make("OrenNayarQuarter", OrenNayar(0.25f), true, true),
      make("OrenNayarOne", OrenNayar(1), true, true),
      make("SheenNarrow", Sheen(0.09f), true, true),
      make("SheenWide", Sheen(0.7f), true, true),
      make("BurleySmooth", BurleyDiffuse(0), true, true),
      make("BurleyRough", BurleyDiffuse(1, 0.6f), true, true),
      make("FacetsSmooth", FacetReflection(0.06f, 0.06f, 1.5f), false, true),
      make("FacetsRough", FacetReflection(0.8f, 0.8f, 2), false, true),
      make("Translucency", Translucency{}, true, true),
      make("GlossySmooth", GlossyReflection(0.06f, 0.06f), false, false),
      make("GlossyMiddle", GlossyReflection(0.3f, 0.3f), false, false),
      make("GlossyAnisotropic", GlossyReflection(0.1f, 0.8f), false, false),
      make("GlossyRough", GlossyReflection(1, 1), false, false),
      make("ThinRough", RoughThinTransmission(0.35f, 0.2f), false, false),
      make("RefractIn", RoughRefraction(0.2f, 0.2f, 1.5f), false, false),
      make("RefractInAnisotropic", RoughRefraction(0.6f, 0.1f, 1.33f), false, false),
      make("RefractOut", RoughRefraction(0.2f, 0.2f, 1 / 1.5f), false, false),
      make("RefractOutRough", RoughRefraction(0.9f, 0.9f, 1 / 1.33f), false, false),
  };
}

const Vec3 kViews[] = {normalize(Vec3(0, 0, 1)), normalize(Vec3(0.5f, -0.3f, 0.8f)),
                       normalize(Vec3(-0.6f, 0.7f, 0.35f)), normalize(Vec3(0.2f, 1, 0.06f))};
constexpr int kDraws = 60000;

Vec3 sphere(const Vec2& u) { return sampling::sample_uniform_sphere(u); }

class LobeContract : public ::testing::TestWithParam<Case> {};

// The whole suite errs with probability 0.01: 19 lobes, 4 views.
TEST_P(LobeContract, DrawsWhatItsDensitySays) {
  const Case& lobe = GetParam();
  const double level = testing::sidak(0.01, static_cast<int>(cases().size() * std::size(kViews)));
  for (const Vec3& wo : kViews) {
    const auto r = testing::test_directions(
        [&](const Vec2& u2, float u1) -> std::optional<Vec3> {
          const auto s = lobe.sample(wo, u2, u1);
          return s ? std::optional(s->wi) : std::nullopt;
        },
        [&](const Vec3& wi) { return lobe.pdf(wo, wi); }, kDraws, 21);
    EXPECT_GT(r.chi.p_value, level) << "wo.z " << wo.z << ": " << r.chi.statistic << " of "
                                    << r.chi.degrees << ", integral " << r.pdf_integral;
    EXPECT_LE(r.pdf_integral, 1.003);
    EXPECT_NEAR(r.pdf_integral, r.drawn, 0.012);
    if (lobe.always_samples) {
      EXPECT_EQ(std::lround(r.drawn * kDraws), kDraws);
      EXPECT_NEAR(r.pdf_integral, 1, 0.003);
    }
  }
}

TEST_P(LobeContract, WeightIsValueOverDensity) {
  const Case& lobe = GetParam();
  for (const Vec3& wo : kViews)
    for (int n = 0; n < 2000; ++n) {
      Sampler r(n, 1, 0);
      const Vec2 u2 = r.next_2d();
      const auto s = lobe.sample(wo, u2, r.next_1d());
      if (!s) continue;
      ASSERT_FALSE(s->delta);
      ASSERT_NEAR(length(s->wi), 1, 1e-5);
      ASSERT_NEAR(s->pdf / lobe.pdf(wo, s->wi), 1, 2e-3);
      ASSERT_NEAR(s->weight * s->pdf / lobe.eval(wo, s->wi), 1, 2e-3);
    }
}

TEST_P(LobeContract, IsNowhereNegative) {
  const Case& lobe = GetParam();
  for (int n = 0; n < 20000; ++n) {
    Sampler r(n, 2, 0);
    const Vec3 wo = sphere(r.next_2d()), wi = sphere(r.next_2d());
    const float f = lobe.eval(wo, wi), p = lobe.pdf(wo, wi);
    ASSERT_TRUE(f >= 0 && p >= 0 && std::isfinite(f) && std::isfinite(p));
    if (wo.z <= 0) {
      ASSERT_EQ(f, 0);
      ASSERT_EQ(p, 0);
      ASSERT_FALSE(lobe.sample(wo, r.next_2d(), 0));
    }
    ASSERT_FALSE(f > 0 && p == 0) << "light that sampling cannot find";
  }
}

TEST_P(LobeContract, ReflectsNoMoreThanItReceives) {
  const Case& lobe = GetParam();
  for (const Vec3& wo : kViews) {
    double by_sampling = 0;
    constexpr std::uint32_t kSamples = 8192;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      Sampler r(9, 9, i);
      const Vec2 u2 = r.next_2d();
      if (const auto s = lobe.sample(wo, u2, r.next_1d())) by_sampling += s->weight / kSamples;
    }
    double by_value = 0;
    for (int cell = 0; cell < 256; ++cell) {
      const double z0 = -1 + (cell / 16) / 8.0, p0 = (cell % 16) * M_PI / 8;
      by_value += testing::integrate(
          [&](double z, double phi) {
            const double s = std::sqrt(1 - z * z);
            return lobe.eval(wo,
                             Vec3(static_cast<float>(s * std::cos(phi)),
                                  static_cast<float>(s * std::sin(phi)), static_cast<float>(z)));
          },
          z0, z0 + 0.125, p0, p0 + M_PI / 8, 2e-6);
    }
    EXPECT_LE(by_sampling, 1.005);
    EXPECT_LE(by_value, 1.005);
    EXPECT_NEAR(by_sampling, by_value, 0.004) << "wo.z " << wo.z;
  }
}

TEST(ReciprocalLobes, SeeTheSameFromBothEnds) {
  for (const Case& lobe : cases()) {
    if (!lobe.reciprocal) continue;
    for (int n = 0; n < 2000; ++n) {
      Sampler r(n, 4, 0);
      const Vec3 a = sampling::sample_cosine_hemisphere(r.next_2d());
      Vec3 b = sampling::sample_cosine_hemisphere(r.next_2d());
      const bool through = lobe.eval(a, b) == 0;
      if (through) b = -b;
      // From the other side, in a frame with reversed normal.
      const Vec3 from = through ? -b : b, to = through ? -a : a;
      ASSERT_NEAR(lobe.eval(a, b) / std::abs(b.z), lobe.eval(from, to) / std::abs(to.z), 1e-5)
          << lobe.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lobes, LobeContract, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

TEST(DeltaLobes, HaveOneDirectionThatNothingElseFinds) {
  const auto check = [](const auto& lobe) {
    const Vec3 wo = kViews[1];
    const auto s = lobe.sample(wo, {0.1f, 0.2f}, 0.3f);
    ASSERT_TRUE(s && s->delta);
    EXPECT_EQ(s->weight, 1);
    EXPECT_EQ(lobe.eval(wo, s->wi), 0);
    EXPECT_EQ(lobe.pdf(wo, s->wi), 0);
    EXPECT_FALSE(lobe.sample(-wo, {0.1f, 0.2f}, 0.3f));
  };
  check(Mirror{});
  check(ClearRefraction{1.5f});
  check(ClearRefraction{0.5f});
  check(ClearThinTransmission{});
}

}  // namespace lobe_contract_test
}  // namespace oriel::bsdf
