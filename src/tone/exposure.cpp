// SPDX-License-Identifier: Apache-2.0
// Photographic and simple exposure: precomputed constants and per-colour curves.
#include "tone/exposure.h"

#include "base/math.h"
#include "color/luminance.h"

#include <algorithm>
#include <limits>

namespace oriel::lens {
namespace {

/// Clamps to a valid input of the curves: non-negative and finite; NaN becomes 0.
float tame(float v) { return v > 0 ? std::min(v, std::numeric_limits<float>::max()) : 0.0f; }
Rgb tame(const Rgb& c) { return Rgb(tame(c.x), tame(c.y), tame(c.z)); }

/// v^exponent for v >= 0, with shortcuts for common exponents.
float power(float v, float exponent) {
  if (exponent == 1) return v;
  return v > 0 ? math::pow(v, exponent) : 0.0f;
}

float inverse_of_gamma(float gamma) { return gamma > 0 ? 1 / gamma : 1.0f; }

/// Factors that map the white point to grey and preserve its luminance.
Rgb white_balance(const Rgb& white) {
  constexpr float kMin = 1e-6f;  // avoids a division by 0 for a white point with a zero channel
  const Rgb w(std::max(white.x, kMin), std::max(white.y, kMin), std::max(white.z, kMin));
  return Rgb(luminance(w)) / w;
}

}  // namespace

float exposure_scale(const PhotographicParameters& p) {
  if (!(p.film_iso > 0)) return p.cm2_factor;
  if (!(p.camera_shutter > 0) || !(p.f_number > 0)) return 0;
  // 2^EV100 = N^2 / t * 100 / S; the shutter is given as 1 / t.
  const float exposure_value = sqr(p.f_number) * p.camera_shutter * 100 / p.film_iso;
  return p.cm2_factor / (p.exposure_constant * exposure_value);
}

PhotographicExposure::PhotographicExposure(const PhotographicParameters& p)
    : scale_(white_balance(p.whitepoint) * exposure_scale(p)),
      vignetting_(p.vignetting),
      burn_(p.burn_highlights),
      saturation_(p.saturation),
      crush_exponent_(1 + 2 * p.crush_blacks),
      inverse_gamma_(inverse_of_gamma(p.gamma)) {}

Rgb PhotographicExposure::operator()(const Rgb& scene, float cos_to_film_plane) const {
  Rgb c = scene * scale_;
  if (vignetting_ != 0 && cos_to_film_plane < 1)
    c *= power(std::max(cos_to_film_plane, 0.0f), vignetting_);
  c = tame(c);

  // Burn: c (1 + burn c) / (1 + c), rewritten to be exact for burn 1 and to avoid overflow.
  if (burn_ != 1)
    for (int i = 0; i < 3; ++i) c[i] = tame(burn_ * c[i] + (1 - burn_) * (c[i] / (1 + c[i])));

  if (saturation_ != 1) {
    const Rgb grey(luminance(c));
    c = tame(grey + (c - grey) * saturation_);
  }

  // Crush: a toe that keeps white unchanged and darkens dark colours most.
  const float y = luminance(c);
  if (crush_exponent_ != 1 && y < 1) {
    const float share = std::sqrt(y);
    for (int i = 0; i < 3; ++i) c[i] = tame(lerp(power(c[i], crush_exponent_), c[i], share));
  }
  return tame(
      Rgb(power(c.x, inverse_gamma_), power(c.y, inverse_gamma_), power(c.z, inverse_gamma_)));
}

SimpleExposure::SimpleExposure(const SimpleParameters& p)
    : p_(p), inverse_gamma_(inverse_of_gamma(p.gamma)) {
  p_.compression = std::max(p_.compression, 0.0f);
}

float SimpleExposure::map(float value) const {
  float v = tame((value + p_.pedestal) * p_.gain);
  const float over = v - p_.knee;
  if (over > 0) {
    // The second form is over / (1 + compression * over), rewritten to avoid overflow.
    v = p_.knee + (p_.curve == KneeCurve::Ratio ? over / (1 + p_.compression)
                                                : 1 / (1 / over + p_.compression));
  }
  return tame(power(tame(v), inverse_gamma_));
}

Rgb SimpleExposure::operator()(const Rgb& c) const { return Rgb(map(c.x), map(c.y), map(c.z)); }

}  // namespace oriel::lens
