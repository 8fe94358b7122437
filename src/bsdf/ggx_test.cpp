// SPDX-License-Identifier: Apache-2.0
#include "bsdf/ggx.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/ggx_albedo.h"
#include "bsdf/ggx_albedo_table.h"
#include "bsdf/gloss.h"
#include "bsdf/glossy_reflection.h"
#include "sampling/sampler.h"
#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace ggx_test {

using testing::cosine_direction;

using sampling::Sampler;

/// Mean of sampled weights: the directional albedo.
double furnace(const GlossyReflection& lobe, const Vec3& wo, std::uint32_t samples = 4096) {
  double sum = 0;
  for (std::uint32_t i = 0; i < samples; ++i)
    if (const auto s = lobe.sample(wo, Sampler(5, 6, i).next_2d(), 0)) sum += s->weight;
  return sum / samples;
}

/// A random roughness within the limits and a random view direction, often grazing.
struct RandomCase {
  float ax, ay;
  Vec3 wo;
};
RandomCase random_case(int n) {
  Sampler s(n, 0, 0, 77);
  const float alpha = kMinAlpha * std::pow(kMaxAlpha / kMinAlpha, s.next_1d());
  const Roughness r = anisotropic_roughness(alpha, std::pow(10.0f, 2 * s.next_1d() - 1));
  const float u = s.next_1d();
  const float cosine = std::max(1e-3f, n % 2 ? u : u * u * u);
  return {r.ax, r.ay, cosine_direction(cosine, kTwoPi * s.next_1d())};
}

TEST(Ggx, ProjectedAreaIsOne) {
  for (const auto& g : {Ggx{0.1f, 0.1f}, Ggx{0.5f, 0.2f}, Ggx{1.2f, 0.12f}}) {
    // Over slopes: D cos^4 is the density of slopes, integrated here over angle and tan = t/(1-t).
    const double integral = testing::integrate(
        [&](double t, double phi) {
          const double tangent = t / (1 - t), c = 1 / std::sqrt(1 + tangent * tangent);
          const Vec3 h = cosine_direction(static_cast<float>(c), static_cast<float>(phi));
          return g.d(h) * c * c * c * c * tangent / ((1 - t) * (1 - t));
        },
        0, 1, 0, 2 * M_PI, 1e-6);
    EXPECT_NEAR(integral, 1, 2e-3);
  }
}

TEST(Ggx, VisibleNormalsMatchTheirDensity) {
  const Vec3 views[] = {cosine_direction(1, 0.3), cosine_direction(0.6f, 0.4f),
                        cosine_direction(0.1f, 2)};
  const Ggx surfaces[] = {{0.35f, 0.35f}, {0.8f, 0.2f}, {0.15f, 1.1f}};
  for (const Vec3& wo : views)
    for (const Ggx& g : surfaces) {
      const auto r =
          testing::test_directions([&](const Vec2& u, float) { return g.sample_visible(wo, u); },
                                   [&](const Vec3& h) { return g.visible_pdf(wo, h); }, 100000, 8);
      EXPECT_GT(r.chi.p_value, testing::sidak(0.01, 9));
      EXPECT_NEAR(r.pdf_integral, 1, 1e-3);
    }
}

// Single scattering, white, isotropic: figures of the reference table, +-0.002.
TEST(GgxAlbedo, MatchesThePublishedLoss) {
  const float mu[] = {1, .8f, .5f, .2f, .05f};
  const double table[][6] = {{.1, .9888, .9849, .9694, .9046, .9118},
                             {.25, .9158, .8973, .8573, .8481, .9332},
                             {.5, .6879, .6820, .6983, .7899, .9126},
                             {.75, .4639, .4923, .5646, .7155, .8805},
                             {1, .3069, .3513, .4507, .6416, .8478}};
  for (const auto& row : table)
    for (int i = 0; i < 5; ++i) {
      const auto a = static_cast<float>(row[0]);
      EXPECT_NEAR(ggx_albedo(a, a, cosine_direction(mu[i], 0.3)), row[i + 1], 0.004)
          << a << ' ' << mu[i];
    }
}

TEST(GgxAlbedo, TableIsTheGeneratorsOutput) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const std::int16_t v : kGgxAlbedoTable)
    hash = (hash ^ static_cast<std::uint16_t>(v)) * 0x100000001b3ull;
  EXPECT_EQ(hash, kGgxAlbedoChecksum);
  EXPECT_EQ(std::size(kGgxAlbedoTable), std::size_t{GgxAlbedoCoordinates::kValues});
}

TEST(GgxAlbedo, MatchesQuadrature) {
  double worst = 0;
  for (int n = 0; n < 800; ++n) {
    const RandomCase c = random_case(n);
    // The furnace test divides quadrature by the table.
    worst = std::max(worst, std::abs(furnace({c.ax, c.ay}, c.wo) - 1));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 0.005);
}

// acceptance: E6
TEST(GlossyReflection, FurnaceIsWhite) {
  for (const GlossModel model : {GlossModel::Nvidia, GlossModel::Linear})
    for (const float gloss : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 0.97f, 0.99f})
      for (const float anisotropy : {0.1f, 0.3f, 1.0f, 2.0f, 10.0f})
        for (const float mu : {0.02f, 0.1f, 0.3f, 0.6f, 1.0f})
          for (const float phi : {0.0f, 0.7f, 1.5f}) {
            const Roughness r = gloss_to_roughness(gloss, anisotropy, model);
            if (r.is_mirror()) continue;  // weight 1: DeltaLobes
            ASSERT_NEAR(furnace({r.ax, r.ay}, cosine_direction(mu, phi), 2048), 1, 0.005)
                << "gloss " << gloss << " anisotropy " << anisotropy << " mu " << mu << " phi "
                << phi;
          }
}

TEST(GlossyReflection, MadeForOneViewerIsTheSameLobe) {
  for (int n = 0; n < 200; ++n) {
    const RandomCase c = random_case(n);
    const GlossyReflection lobe(c.ax, c.ay), made(c.ax, c.ay, c.wo);
    const Vec2 u = Sampler(n, 9, 0).next_2d();
    const auto a = lobe.sample(c.wo, u, 0), b = made.sample(c.wo, u, 0);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->wi, b->wi);
    EXPECT_FLOAT_EQ(a->weight, b->weight);
    EXPECT_FLOAT_EQ(lobe.eval(c.wo, a->wi), made.eval(c.wo, a->wi));
  }
}

// acceptance: E4
TEST(GlossyReflection, HighlightNarrowsAtConstantEnergy) {
  const Vec3 wo = cosine_direction(0.8f, 0.3), mirrored(-wo.x, -wo.y, wo.z);
  float peak = 0;
  for (float gloss = 0; gloss < 0.96f; gloss += 0.05f) {
    const Roughness r = gloss_to_roughness(gloss);
    const GlossyReflection lobe(r.ax, r.ay);
    EXPECT_NEAR(furnace(lobe, wo), 1, 0.01);
    EXPECT_GT(lobe.eval(wo, mirrored), 1.5f * peak);
    peak = lobe.eval(wo, mirrored);
  }
}

/// Angle from the mirror direction at which the highlight has half its peak, along azimuth phi.
double half_width(const GlossyReflection& lobe, float phi) {
  const Vec3 wo(0, 0, 1);
  const float half = 0.5f * lobe.eval(wo, wo);
  double lo = 0, hi = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (lo + hi);
    (lobe.eval(wo, cosine_direction(static_cast<float>(std::cos(mid)), phi)) > half ? lo : hi) =
        mid;
  }
  return lo;
}

// acceptance: A1
TEST(GlossyReflection, WidthsHaveTheRatioAsked) {
  for (const float anisotropy : {0.1f, 0.25f, 1.0f, 3.0f, 10.0f}) {
    const Roughness r = gloss_to_roughness(0.5f, anisotropy);
    const Roughness t = gloss_to_roughness(0.5f, 1 / anisotropy);
    const double x = half_width({r.ax, r.ay}, 0), y = half_width({r.ax, r.ay}, kPi / 2);
    EXPECT_NEAR(x / y / anisotropy, 1, 0.03);
    EXPECT_NEAR(half_width({t.ax, t.ay}, kPi / 2) / x, 1, 0.01);
    EXPECT_NEAR(half_width({t.ax, t.ay}, 0) / y, 1, 0.01);
  }
}

TEST(GlossyReflection, StaysFiniteAtTheNarrowestAndWidest) {
  for (const auto& [ax, ay] : {std::pair{kMinAlpha, kMinAlpha},
                               {kMaxAlpha, kMinAlpha},
                               {kMinAlpha, kMaxAlpha},
                               {kMaxAlpha, kMaxAlpha}}) {
    const GlossyReflection lobe(ax, ay);
    for (int n = 0; n < 4000; ++n) {
      Sampler s(n, 3, 0);
      const Vec3 wo = cosine_direction(std::max(1e-4f, s.next_1d()), kTwoPi * s.next_1d());
      const auto r = lobe.sample(wo, s.next_2d(), 0);
      if (!r) continue;
      ASSERT_TRUE(is_finite(r->wi) && std::isfinite(r->weight) && std::isfinite(r->pdf));
      ASSERT_NEAR(length(r->wi), 1, 1e-5);
      ASSERT_GE(r->weight, 0);
      ASSERT_GT(r->pdf, 0);
    }
  }
}

TEST(RoughThinTransmission, CentresOnTheStraightWay) {
  const RoughThinTransmission lobe(0.02f, 0.02f);
  const Vec3 wo = cosine_direction(0.7f, 0.3);
  Vec3 mean(0, 0, 0);
  for (std::uint32_t i = 0; i < 4096; ++i)
    if (const auto s = lobe.sample(wo, Sampler(0, 0, i).next_2d(), 0)) mean += s->wi * s->weight;
  EXPECT_GT(dot(normalize(mean), -wo), 0.9999f);
}

}  // namespace ggx_test
}  // namespace oriel::bsdf
