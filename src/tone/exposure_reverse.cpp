// SPDX-License-Identifier: Apache-2.0
#include "tone/exposure_reverse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "color/luminance.h"

namespace oriel::lens {
namespace {

float compress(float v) { return v > 0 ? std::min(v, std::numeric_limits<float>::max()) : 0.0f; }
Rgb compress(const Rgb& c) { return Rgb(compress(c.x), compress(c.y), compress(c.z)); }

/// Solves lerp(x^exponent, x, share) = `value` for x >= 0 by Newton's method, which converges from
/// any larger start, since the function is increasing and convex for exponents >= 1.
double before_toe(double value, double exponent, double share) {
  if (!(value > 0)) return 0;
  // Neither of the two terms exceeds their sum.
  double x = math::pow(value / std::max(1 - share, 1e-12), 1 / exponent);
  if (share > 0) x = std::min(x, value / share);
  constexpr int kMaxSteps = 30;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double toe = (1 - share) * math::pow(x, exponent);
    const double step = (toe + share * x - value) / (exponent * toe / x + share);
    x -= step;
    if (!(step > 1e-8 * x)) break;
  }
  return x;
}

/// Factors from scene light to exposed values.
Rgb forward_scale(const PhotographicParameters& parameters) {
  PhotographicParameters p = parameters;
  p.vignetting = 0;
  p.burn_highlights = 1;
  p.crush_blacks = 0;
  p.saturation = 1;
  p.gamma = 1;
  return PhotographicExposure(p)(Rgb(1));
}

}  // namespace

ReversePhotographicExposure::ReversePhotographicExposure(const PhotographicParameters& p)
    : vignetting_(p.vignetting),
      burn_(p.burn_highlights),
      saturation_(p.saturation),
      crush_exponent_(1 + 2 * p.crush_blacks),
      gamma_(p.gamma > 0 ? p.gamma : 1) {
  const Rgb scale = forward_scale(p);
  for (int k = 0; k < 3; ++k) inverse_scale_[k] = scale[k] > 0 ? 1 / scale[k] : 0;
}

Rgb ReversePhotographicExposure::uncrushed(const Rgb& c) const {
  // Colours with luminance 1 or more are unchanged by crush.
  const float shown = luminance(c);
  if (crush_exponent_ == 1 || !(shown > 0) || shown >= 1) return c;
  // double: slopes are steep at the start of the toe.
  const auto before = [&](double y) {
    const double share = std::sqrt(y);
    return Rgb(static_cast<float>(before_toe(double(c.x), double(crush_exponent_), share)),
               static_cast<float>(before_toe(double(c.y), double(crush_exponent_), share)),
               static_cast<float>(before_toe(double(c.z), double(crush_exponent_), share)));
  };
  // The difference is positive at luminance 0 and negative at 1. False position, halving the value
  // of an end that is retained twice (Dowell, Jarratt 1971).
  double low = 0, high = 1, over = double(luminance(before(low))), under = double(shown) - 1;
  Rgb found(0);
  constexpr int kMaxSteps = 60;
  for (int i = 0, side = 0; i < kMaxSteps; ++i) {
    const double y = (low * under - high * over) / (under - over);
    found = before(y);
    const double more = double(luminance(found)) - y;
    if (std::abs(more) < 1e-7 * y || high - low < 1e-9) break;
    if (more > 0) {
      low = y;
      over = more;
      if (side == 1) under *= 0.5;
      side = 1;
    } else {
      high = y;
      under = more;
      if (side == -1) over *= 0.5;
      side = -1;
    }
  }
  return found;
}

Rgb ReversePhotographicExposure::unsaturated(const Rgb& c) const {
  if (saturation_ == 1) return c;
  const Rgb grey(luminance(c));
  return saturation_ > 0 ? compress(grey + (c - grey) / saturation_) : grey;
}

float ReversePhotographicExposure::unburnt(float value) const {
  if (burn_ == 1) return value;
  if (!(burn_ > 0)) {
    const float v = std::min(value, kBrightestShown);
    return v / (1 - v);
  }
  // Solves burn c^2 + (1 - value) c - value = 0 in a form without cancellation for small values.
  const double b = double(burn_), v = double(value), p = 1 - v;
  const double root = std::sqrt(p * p + 4 * b * v);
  return static_cast<float>(p > 0 ? 2 * v / (p + root) : (root - p) / (2 * b));
}

Rgb ReversePhotographicExposure::operator()(const Rgb& display, float cos_to_film_plane) const {
  Rgb c = compress(display);
  for (int k = 0; k < 3; ++k) c[k] = math::pow(c[k], gamma_);
  c = unsaturated(uncrushed(compress(c)));
  for (int k = 0; k < 3; ++k) c[k] = unburnt(c[k]);
  if (vignetting_ != 0 && cos_to_film_plane < 1)
    c /= math::pow(std::max(cos_to_film_plane, kMinCosine), vignetting_);
  return compress(c * inverse_scale_);
}

}  // namespace oriel::lens
