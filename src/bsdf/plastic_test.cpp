// SPDX-License-Identifier: Apache-2.0
// The lobes of a plastic: diffuse light with retro-reflection, and facets of a dielectric.
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/burley_diffuse.h"
#include "bsdf/facet_albedo.h"
#include "bsdf/facet_reflection.h"
#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace plastic_test {

using testing::polar_direction;

/// Directional albedo, integrated over azimuth and sin^2.
template <class L>
double integral(const L& lobe, const Vec3& wo) {
  double sum = 0;
  for (int band = 0; band < 8; ++band)
    sum += testing::integrate(
        [&](double v, double phi) {
          const double s = std::sqrt(v), c = std::sqrt(1 - v);
          const Vec3 wi(static_cast<float>(s * std::cos(phi)),
                        static_cast<float>(s * std::sin(phi)), static_cast<float>(c));
          return lobe.eval(wo, wi) / (2 * c);
        },
        band / 8.0, (band + 1) / 8.0, 0, 2 * M_PI, 1e-6);
  return sum;
}

// The form of the paper: by the Schlick weights and F_D90 = 1/2 + 2 roughness cos^2 of the angle
// between light and half vector.
TEST(BurleyDiffuse, IsTheFormOfThePaper) {
  for (const double roughness : {0.0, 0.4, 1.0})
    for (double to = 2; to < 90; to += 12)
      for (double ti = 3; ti < 90; ti += 14)
        for (const double turn : {0.0, 70.0, 180.0}) {
          const Vec3 wo = polar_direction(to), wi = polar_direction(ti, turn);
          const double half = dot(wi, normalize(wo + wi));
          const double f90 = 0.5 + 2 * roughness * half * half;
          const auto weight = [&](double c) { return 1 + (f90 - 1) * std::pow(1 - c, 5); };
          const double expected = weight(wo.z) * weight(wi.z) * wi.z / M_PI;
          EXPECT_NEAR(BurleyDiffuse(static_cast<float>(roughness)).eval(wo, wi), expected, 2e-6);
        }
}

TEST(BurleyDiffuse, AlbedoIsNearTheIntegral) {
  for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f})
    for (const double degrees : {1.0, 40.0, 65.0, 80.0}) {
      const Vec3 wo = polar_direction(degrees);
      const double expected = integral(BurleyDiffuse(roughness), wo);
      EXPECT_NEAR(BurleyDiffuse::albedo(roughness, wo.z), expected, 0.03 * expected)
          << roughness << ' ' << degrees;
    }
}

TEST(FacetReflection, AlbedoIsTheIntegral) {
  for (const float alpha : {0.1f, 0.3f, 0.65f, 1.0f})
    for (const float eta : {1.02f, 1.2f, 1.5f, 2.1f, 5.0f})
      for (const double degrees : {1.0, 40.0, 70.0, 82.0}) {
        const Vec3 wo = polar_direction(degrees);
        const double expected = integral(FacetReflection(alpha, alpha, eta), wo);
        EXPECT_NEAR(facet_albedo(alpha, eta, wo.z), expected, 0.01)
            << alpha << ' ' << eta << ' ' << degrees;
      }
}

TEST(FacetReflection, SmoothFacetsReflectAsAPlane) {
  for (const double degrees : {5.0, 45.0, 70.0}) {
    const Vec3 wo = polar_direction(degrees);
    const float expected = fresnel_dielectric(wo.z, 1.5f);
    EXPECT_NEAR(integral(FacetReflection(0.05f, 0.05f, 1.5f), wo), expected, 0.05 * expected);
  }
}

TEST(FacetReflection, IsTheTorranceSparrowModel) {
  // At 60 degrees to both sides the half vector is the normal: D = 1 / (pi alpha^2),
  // lambda = (sqrt(1 + 3 alpha^2) - 1) / 2, F = .0891867 of an index of 1.5.
  const double a2 = 0.25 * 0.25, lambda = (std::sqrt(1 + 3 * a2) - 1) / 2;
  const double expected = 0.0891867 / (M_PI * a2) / (1 + 2 * lambda) / (4 * 0.5);
  const float value =
      FacetReflection(0.25f, 0.25f, 1.5f).eval(polar_direction(60), polar_direction(60, 180));
  EXPECT_NEAR(value, expected, 1e-4 * expected);
  EXPECT_FLOAT_EQ(
      FacetReflection(0.25f, 0.25f, 1.5f, 3).eval(polar_direction(60), polar_direction(60, 180)),
      3 * value);
}

}  // namespace plastic_test
}  // namespace oriel::bsdf
