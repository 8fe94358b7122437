// SPDX-License-Identifier: Apache-2.0
// The sheen of cloth, and its albedo.
#include "bsdf/sheen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sampling/testing/chi_square.h"
#include "support/directions.h"

namespace oriel::bsdf {
namespace sheen_test {

using testing::polar_direction;

/// Integral of the lobe by the published formulas, in double precision and in polar angles.
double published_albedo(double alpha, double theta) {
  const double narrow = (1 - alpha) * (1 - alpha);
  const auto mix = [&](double wide, double sharp) { return wide + narrow * (sharp - wide); };
  const double a = mix(21.5473, 25.3245), b = mix(3.82987, 3.32435), c = mix(.19823, .16801),
               d = mix(-1.97760, -1.27393), e = mix(-4.32054, -4.85967);
  const auto fit = [&](double x) { return a / (1 + b * std::pow(x, c)) + d * x + e; };
  const auto lambda = [&](double x) {
    return std::exp(x < .5 ? fit(x) : 2 * fit(.5) - fit(1 - x));
  };
  const double co = std::cos(theta), so = std::sin(theta);
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double t = (i + .5) * M_PI / 2 / kSteps, phi = (j + .5) * M_PI / kSteps;
      const double ci = std::cos(t), si = std::sin(t);
      const double hz = co + ci, hx = so + si * std::cos(phi), hy = si * std::sin(phi);
      const double sine2 = (hx * hx + hy * hy) / (hx * hx + hy * hy + hz * hz);
      const double dist = (2 + 1 / alpha) * std::pow(sine2, .5 / alpha) / (2 * M_PI);
      sum += dist / ((1 + lambda(co) + lambda(ci)) * 4 * co) * si;
    }
  return sum * 2 * (M_PI / 2 / kSteps) * (M_PI / kSteps);
}

TEST(Sheen, AlbedoIsTheIntegral) {
  for (const double alpha : {.04, .1, .3, .7, 1.})
    for (const double degrees : {0., 30., 60., 75., 85.}) {
      const double theta = degrees * M_PI / 180;
      EXPECT_NEAR(sheen_albedo(static_cast<float>(alpha), static_cast<float>(std::cos(theta))),
                  published_albedo(alpha, theta), .005)
          << alpha << ' ' << degrees;
    }
}

TEST(Sheen, ReflectsLessThanItReceivesExceptAtGrazingAngles) {
  for (float alpha = 0; alpha <= 1; alpha += .05f)
    for (float cosine = .15f; cosine <= 1; cosine += .05f) {
      EXPECT_LE(sheen_albedo(alpha, cosine), 1) << alpha << ' ' << cosine;
      EXPECT_GE(sheen_albedo(alpha, cosine), 0);
    }
  EXPECT_GT(sheen_albedo(0, .01f), 1) << "users have to limit it";
}

TEST(Sheen, IsBrightestAtGrazingAngles) {
  const Sheen sheen(.1f);
  const auto seen = [&](double degrees) {
    const Vec3 wo = polar_direction(degrees);
    return sheen.eval(wo, polar_direction(degrees, 90));
  };
  EXPECT_LT(seen(10), .01f);
  EXPECT_GT(seen(80), 5 * seen(40));
  EXPECT_EQ(sheen.eval(Vec3(0, 0, 1), Vec3(0, 0, 1)), 0);
  EXPECT_EQ(sheen.eval(Vec3(0, 0, 1), Vec3(0, 0, -1)), 0);
}

}  // namespace sheen_test
}  // namespace oriel::bsdf
