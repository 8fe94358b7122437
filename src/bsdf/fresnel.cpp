// SPDX-License-Identifier: Apache-2.0
#include "bsdf/fresnel.h"

#include "base/math.h"

namespace oriel::bsdf {
namespace {

// Double: near n = 1 terms of order 1 / (n - 1)^2 cancel.
// Source: Duntley 1942 as given in Egan, Hilgeman, "Optical Properties of Inhomogeneous
// Materials", 1979, for n > 1.
double mean_from_outside(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / math::pow(n2 + 1, 3) * math::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * math::log(n);
}

}  // namespace

float fresnel_dielectric_mean(float eta) {
  constexpr double kNearOne = 1.001;  // below, linear interpolation to 0 is within 1e-5
  const double n = eta < 1 ? 1 / static_cast<double>(eta) : static_cast<double>(eta);
  const double outside =
      n < kNearOne ? mean_from_outside(kNearOne) * (n - 1) / (kNearOne - 1) : mean_from_outside(n);
  // Transmission from inside is transmission from outside divided by n^2.
  return static_cast<float>(eta < 1 ? 1 - (1 - outside) / (n * n) : outside);
}

}  // namespace oriel::bsdf
