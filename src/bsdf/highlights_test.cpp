// SPDX-License-Identifier: Apache-2.0
#include "bsdf/highlights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/fresnel.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace highlights_test {

using testing::polar_direction;

/// Integral over the hemisphere of lights: the directional albedo.
template <class H>
double albedo(const H& highlight, const Vec3& wo) {
  constexpr int kN = 600;
  double sum = 0;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const float z = (static_cast<float>(i) + .5f) / kN;
      const float phi = kTwoPi * (static_cast<float>(j) + .5f) / kN;
      const float r = std::sqrt(1 - z * z);
      sum += highlight.eval(wo, Vec3(r * std::cos(phi), r * std::sin(phi), z));
    }
  return sum * kTwoPi / (double(kN) * kN);
}

template <class H>
void expect_reciprocal(const H& highlight) {
  for (int i = 0; i < 50; ++i) {
    const Vec3 a = polar_direction(static_cast<float>(i) * 1.7f, static_cast<float>(i) * 37);
    const Vec3 b =
        polar_direction(static_cast<float>(49 - i) * 1.6f, static_cast<float>(i) * 91 + 10);
    const float ab = highlight.eval(a, b) / b.z, ba = highlight.eval(b, a) / a.z;
    EXPECT_NEAR(ab, ba, 1e-4f * std::max(1e-4f, ab)) << i;
  }
}

TEST(Highlights, WardIsNormalisedForSmallSlopes) {
  // Exact for slopes near zero at normal incidence. Off-normal it decreases with the cosine, which
  // later papers correct: Duer, "An Improved Normalization for the Ward Reflectance Model", JGT
  // 2006.
  EXPECT_NEAR(albedo(WardHighlight{.05f, .05f}, polar_direction(0)), 1, .02);
  EXPECT_NEAR(albedo(WardHighlight{.05f, .1f}, polar_direction(0)), 1, .03);
  EXPECT_NEAR(albedo(WardHighlight{.06f, .06f}, polar_direction(30)), std::cos(kPi / 6), .02);
}

TEST(Highlights, WardAndTorranceAreReciprocal) {
  expect_reciprocal(WardHighlight{.3f, .1f});
  expect_reciprocal(TorranceHighlight{.3f, 1.7f});
}

TEST(Highlights, WardMatchesItsFormula) {
  // In the mirror direction the exponent is 0: 1 / (4 pi ax ay).
  const Vec3 wo = polar_direction(40), mirrored = polar_direction(40, 180);
  EXPECT_NEAR((WardHighlight{.2f, .1f}.eval(wo, mirrored)), 1 / (4 * kPi * .02f), 1e-3);
  // Lights at 20 degrees to both sides of the normal of a facet of slope tan(20).
  const Vec3 wi = polar_direction(40);
  const float t = std::tan(20 * kPi / 180);
  const float expected =
      std::exp(-sqr(t / .2f)) * std::sqrt(std::cos(40 * kPi / 180)) / (4 * kPi * .2f * .1f);
  EXPECT_NEAR((WardHighlight{.2f, .1f}.eval(polar_direction(0), wi)), expected, 1e-4f * expected);
  EXPECT_GT((WardHighlight{.2f, .1f}.eval(polar_direction(0), polar_direction(20, 0))),
            (WardHighlight{.2f, .1f}.eval(polar_direction(0), polar_direction(20, 90))));
}

TEST(Highlights, TorranceReflectsWhatFresnelSaysOfSmoothFacets) {
  for (const float degrees : {0.f, 30.f, 50.f}) {
    const float f = fresnel_dielectric(std::cos(degrees * kPi / 180), 1.5f);
    EXPECT_NEAR(albedo(TorranceHighlight{.06f, 1.5f}, polar_direction(degrees)), f, .05 * f)
        << degrees;
  }
  EXPECT_EQ((TorranceHighlight{.3f, 1}.eval(polar_direction(10), polar_direction(30))), 0)
      << "an index of 1 reflects nothing";
}

TEST(Highlights, TorrancePeaksBeyondTheMirrorDirection) {
  // Cook, Torrance 1982: at grazing angles the peak is closer to the surface.
  const TorranceHighlight rough{.4f, 1.5f};
  const Vec3 wo = polar_direction(65);
  float best = 0, at = 0;
  for (float d = 40; d < 90; d += .5f)
    if (const float v = rough.eval(wo, polar_direction(d, 180)); v > best) best = v, at = d;
  EXPECT_GT(at, 67);
}

TEST(Highlights, HairMirrorsInAConeAboutTheFibre) {
  const HairHighlight hair{10};
  // A light at the mirror angle to the fibre has the full value, at any azimuth.
  const Vec3 wo(.6f, 0, .8f);
  for (const Vec3& wi : {Vec3(-.6f, 0, .8f), Vec3(-.6f, .8f, 0), Vec3(-.6f, 0, -.8f)})
    EXPECT_NEAR(hair.eval(wo, wi), kInvPi, 1e-5f);
  // At an angle to the cone: cos^n of that angle.
  const float a = std::asin(.6f) + .2f;
  EXPECT_NEAR(hair.eval(wo, Vec3(-std::sin(a), 0, std::cos(a))),
              std::pow(std::cos(.2f), 10) * kInvPi, 1e-4f);
}

TEST(Highlights, NothingShinesFromBehindASurface) {
  EXPECT_EQ((WardHighlight{}.eval(polar_direction(10), polar_direction(100))), 0);
  EXPECT_EQ((TorranceHighlight{}.eval(polar_direction(100), polar_direction(10))), 0);
}

}  // namespace highlights_test
}  // namespace oriel::bsdf
