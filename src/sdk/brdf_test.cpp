// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/ward_lobe.h"
#include "oriel/sdk/shader/brdf.h"
#include "oriel/sdk/shader/call.h"
#include "sampling/testing/chi_square.h"
#include "sdk/testing/bare_state.h"
#include "support/directions.h"

namespace oriel::sdk {
namespace brdf_test {

using bsdf::WardLobe;
using testing::BareState;
using testing::cosine_direction;
using testing::integrate;

constexpr miVector kNormal = {0, 0, 1};

miVector reversed(miVector v) {
  mi_vector_neg(&v);
  return v;
}

TEST(Fresnel, MatchesClosedForms) {
  EXPECT_NEAR(mi_fresnel(1, 1.5f, 1, 1), .04f, 1e-6f);
  // At Brewster's angle only one polarisation is left: half of ((n^2 - 1) / (n^2 + 1))^2.
  const float sine = 1.5f / std::sqrt(3.25f), cosine = 1 / std::sqrt(3.25f);
  const float half = .5f * sqr(1.25f / 3.25f);
  EXPECT_NEAR(mi_fresnel(1, 1.5f, cosine, std::sqrt(1 - sqr(sine / 1.5f))), half, 1e-6f);
  BareState bare;
  bare.look_down(sine, cosine);
  EXPECT_NEAR(mi_fresnel_reflection(&bare.state(), 1, 1.5f), half, 1e-6f);
  EXPECT_EQ(mi_fresnel_reflection(&bare.state(), 1.5f, 1), 1) << "past the critical angle";
}

TEST(Highlights, OfPhongArePowersOfTheCosine) {
  BareState bare;
  bare.look_down(.6f, .8f);
  const miVector mirror = {.6f, 0, .8f}, off = as_c(cosine_direction(.8, 0.5)),
                 below = {.6f, 0, -.8f};
  EXPECT_NEAR(mi_phong_specular(30, &bare.state(), &mirror), 1, 1e-4f);
  const float c = mi_vector_dot(&mirror, &off);
  EXPECT_NEAR(mi_phong_specular(30, &bare.state(), &off), std::pow(c, 30.0f), 1e-5f);
  EXPECT_EQ(mi_phong_specular(30, &bare.state(), &below), 0);
  // Blinn's form: the half vector of (-.6, 0, .8) and straight up is (-1, 0, 3) / sqrt(10).
  const miVector up = {0, 0, 1};
  EXPECT_NEAR(mi_blong_specular(10, &bare.state(), &mirror), 1, 1e-5f);
  EXPECT_NEAR(mi_blong_specular(10, &bare.state(), &up), std::pow(.9f, 5.0f), 1e-5f);
  float ns, ks;
  mi_fresnel_specular(&ns, &ks, 30, &bare.state(), &mirror, 1, 1.5f);
  EXPECT_NEAR(ns, 1, 1e-4f);
  EXPECT_EQ(ks, mi_fresnel_reflection(&bare.state(), 1, 1.5f));
}

TEST(Highlights, OfFacetsMatchTheClosedFormStraightAhead) {
  // F D pi / 4 with D = 1 / (pi m^2).
  const miVector down = {0, 0, -1};
  EXPECT_NEAR(mi_blinn_specular(&down, &kNormal, &kNormal, .3f, 1.5f), .04f / (4 * .09f), 1e-5f);
  miColor c;
  const miColor ior = {1.5f, 2, 1, 1};
  ASSERT_TRUE(mi_cooktorr_specular(&c, &down, &kNormal, &kNormal, .3f, &ior));
  EXPECT_NEAR(c.r, .04f / .36f, 1e-5f);
  EXPECT_NEAR(c.g, (1 / 9.0f) / .36f, 1e-5f);
  EXPECT_NEAR(c.b, 0, 1e-6f);
  const miVector behind = {0, 0, -1};
  EXPECT_FALSE(mi_cooktorr_specular(&c, &down, &behind, &kNormal, .3f, &ior));
}

TEST(Highlights, AreReciprocalButForTheCosine) {
  const miVector a = as_c(cosine_direction(.7, .3)), b = as_c(cosine_direction(.4, 2));
  const miVector from_a = reversed(a), from_b = reversed(b);
  EXPECT_NEAR(mi_blinn_specular(&from_a, &b, &kNormal, .5f, 1.5f) / b.z,
              mi_blinn_specular(&from_b, &a, &kNormal, .5f, 1.5f) / a.z, 1e-5f);
  EXPECT_NEAR(mi_ward_glossy(&from_a, &b, &kNormal, 2), mi_ward_glossy(&from_b, &a, &kNormal, 2),
              1e-5f);
}

TEST(Highlights, WardConservesEnergy) {
  for (const float shiny : {2.0f, 5.0f, 15.0f})
    for (const double cosine : {1.0, .7, .3, .1}) {
      const miVector from = reversed(as_c(cosine_direction(cosine, 0)));
      // A white Lambert surface has the value 1, so the total reflected light is pi.
      const double albedo = integrate(
                                [&](double z, double phi) {
                                  const miVector to = as_c(cosine_direction(z, phi));
                                  return z * mi_ward_glossy(&from, &to, &kNormal, shiny);
                                },
                                0, 1, -M_PI, M_PI, 1e-4, 10) /
                            M_PI;
      EXPECT_LE(albedo, 1.001) << shiny << " " << cosine;
      if (shiny == 15 && cosine == 1) {
        EXPECT_GT(albedo, .97);
      }
    }
}

TEST(Highlights, OfWardAreAsWideAsItsDirections) {
  // Straight ahead the lobe divided by the facet density is 1 / pi, up to the cosines.
  const miVector down = {0, 0, -1}, u = {1, 0, 0}, v = {0, 1, 0};
  for (const double phi : {0.0, .8, 1.57}) {
    const miVector to = as_c(cosine_direction(.99, phi));
    const float value = mi_ward_anisglossy(&down, &to, &kNormal, &u, &v, 4, 12);
    const float density = WardLobe(4, 12).pdf(Vec3(0, 0, 1), vec(to));
    EXPECT_NEAR(value / (kPi * density), 1, .02f) << phi;
  }
  EXPECT_EQ(mi_ward_anisglossy(&down, &u, &kNormal, &u, &v, 7, 7),
            mi_ward_glossy(&down, &u, &kNormal, 7));
}

TEST(PhaseFunction, IntegratesToOneWithForwardMean) {
  const miVector along = {0, 0, 1};
  for (const float k : {-.9f, -.4f, 0.0f, .5f, .95f}) {
    double whole = 0, mean_cosine = 0;
    for (int i = 0; i < 20000; ++i) {
      const double c = -1 + (i + .5) / 10000;
      const miVector to = as_c(cosine_direction(c, 0));
      const double p = mi_schlick_scatter(&along, &to, k) * 2 * M_PI / 10000;
      whole += p;
      mean_cosine += p * c;
    }
    EXPECT_NEAR(whole, 1, 1e-3) << k;
    EXPECT_GE(mean_cosine * k, 0) << k;
  }
  const miVector ahead = {0, 0, 1};
  EXPECT_NEAR(mi_schlick_scatter(&along, &ahead, 0), 1 / (4 * M_PI), 1e-6);
}

TEST(PhaseFunction, FirstLobeIsChosenWithItsProbability) {
  BareState bare;
  int first = 0;
  for (int i = 0; i < 10000; ++i) {
    bare.numbers.start(i);
    first += mi_choose_lobe(&bare.state(), .3f);
  }
  EXPECT_NEAR(first, 3000, 4 * 46);
}

TEST(Colours, LuminanceUsesTheWeightsOfTheOptions) {
  BareState bare("luminance weight .5 .25 .25");
  const miColor c = {1, 2, 4, 1};
  EXPECT_NEAR(mi_luminance(&bare.state(), &c), 2, 1e-6f);
}

TEST(Colours, WhiteIsD65AndRoundTrips) {
  miColor c = {1, 1, 1, .5f};
  mi_colorprofile_internal_to_ciexyz(&c);
  EXPECT_NEAR(c.r, .9505f, 1e-4f);
  EXPECT_NEAR(c.g, 1, 1e-4f);
  EXPECT_NEAR(c.b, 1.0890f, 2e-4f);
  EXPECT_EQ(c.a, .5f);
  mi_colorprofile_ciexyz_to_render(&c);
  mi_colorprofile_render_to_internal(&c);
  EXPECT_NEAR(c.r, 1, 1e-5f);
  EXPECT_NEAR(c.g, 1, 1e-5f);
  EXPECT_NEAR(c.b, 1, 1e-5f);
}

}  // namespace brdf_test
}  // namespace oriel::sdk
