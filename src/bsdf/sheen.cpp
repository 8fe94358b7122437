// SPDX-License-Identifier: Apache-2.0
#include "bsdf/sheen.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oriel::bsdf {
namespace {

constexpr int kCosines = 40, kWidths = 20;
constexpr float kLeastCosine = 1e-4f;

/// Integral of the lobe over the hemisphere times the cosine, which stays finite at the horizon.
/// Midpoints in the azimuth and in the root of the cosine: most light is near the horizon.
float integrated(float alpha, float cosine) {
  constexpr int kRings = 64, kAzimuths = 24;
  const Sheen sheen(alpha);
  const Vec3 wo(std::sqrt(std::max(0.0f, 1 - cosine * cosine)), 0, cosine);
  double sum = 0;  // of thousands of terms
  for (int ring = 0; ring < kRings; ++ring) {
    const float root = (static_cast<float>(ring) + .5f) / kRings;
    const float z = root * root, r = std::sqrt(1 - z * z);
    for (int i = 0; i < kAzimuths; ++i) {  // half a circle: the lobe is symmetrical
      const float phi = kPi * (static_cast<float>(i) + .5f) / kAzimuths;
      sum += 2 * root * sheen.eval(wo, Vec3(r * math::cos(phi), r * math::sin(phi), z));
    }
  }
  return static_cast<float>(cosine * sum * 2 * double{kPi} / (kRings * kAzimuths));
}

/// Rows for widths of equal steps; the root of the cosine has equal steps as well.
const std::vector<float>& albedo_table() {
  static const std::vector<float> table = [] {
    std::vector<float> values;
    values.reserve(std::size_t{kWidths} * kCosines);
    for (int j = 0; j < kWidths; ++j) {
      const float width = static_cast<float>(j) / (kWidths - 1);
      const float alpha = std::max(width * width, kMinSheenAlpha);
      for (int i = 0; i < kCosines; ++i)
        values.push_back(
            integrated(alpha, std::max(sqr(static_cast<float>(i) / (kCosines - 1)), kLeastCosine)));
    }
    return values;
  }();
  return table;
}

}  // namespace

Sheen::Sheen(float alpha) {
  alpha = clamp(alpha, kMinSheenAlpha, 1);
  exponent_ = 1 / alpha;
  peak_ = (2 + exponent_) / kTwoPi;
  const float narrow = sqr(1 - alpha);
  a_ = lerp(21.5473f, 25.3245f, narrow);
  b_ = lerp(3.82987f, 3.32435f, narrow);
  c_ = lerp(.19823f, .16801f, narrow);
  d_ = lerp(-1.97760f, -1.27393f, narrow);
  e_ = lerp(-4.32054f, -4.85967f, narrow);
  middle_ = a_ / (1 + b_ * math::pow(.5f, c_)) + d_ * .5f + e_;
}

float Sheen::lambda(float cosine) const {
  const auto fit = [&](float x) { return a_ / (1 + b_ * math::pow(x, c_)) + d_ * x + e_; };
  return math::exp(cosine < .5f ? fit(cosine) : 2 * middle_ - fit(1 - cosine));
}

float Sheen::eval(const Vec3& wo, const Vec3& wi) const {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  const Vec3 h = normalize(wo + wi);
  const float sine = std::sqrt(std::max(0.0f, 1 - h.z * h.z));
  if (sine <= 0) return 0;
  const float d = peak_ * math::pow(sine, exponent_);
  return d / ((1 + lambda(wo.z) + lambda(wi.z)) * 4 * wo.z);
}

float sheen_albedo(float alpha, float cosine) {
  const std::vector<float>& table = albedo_table();
  cosine = clamp(cosine, kLeastCosine, 1);
  const float x = std::sqrt(cosine) * (kCosines - 1);
  const float y = std::sqrt(clamp01(alpha)) * (kWidths - 1);
  const int i = std::min(static_cast<int>(x), kCosines - 2);
  const int j = std::min(static_cast<int>(y), kWidths - 2);
  const auto row = [&](int k) {
    const float* value =
        &table[static_cast<std::size_t>(k) * kCosines + static_cast<std::size_t>(i)];
    return lerp(value[0], value[1], x - static_cast<float>(i));
  };
  return lerp(row(j), row(j + 1), y - static_cast<float>(j)) / cosine;
}

}  // namespace oriel::bsdf
