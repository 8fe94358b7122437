// SPDX-License-Identifier: Apache-2.0
#include "lens/aperture.h"

#include <algorithm>

#include "base/fraction.h"
#include "base/math.h"

namespace oriel::lens {
namespace {

/// With a smaller bias all samples are at the centre; keeps the exponent finite.
constexpr float kMinBias = 1e-4f;
constexpr int kMaxBlades = 1 << 16;

float usable(float v) { return v > 0 && std::isfinite(v) ? v : 0.0f; }

Vec2 on_circle(float turns) { return Vec2(math::cos(kTwoPi * turns), math::sin(kTwoPi * turns)); }

}  // namespace

Aperture::Aperture(int blade_count, float blade_angle, float bias)
    : blades_(blade_count < 3 ? 0 : std::min(blade_count, kMaxBlades)),
      angle_(std::isfinite(blade_angle) ? fraction(blade_angle) : 0.0f),
      exponent_(0.5f / (bias > kMinBias ? bias : kMinBias)) {}

Aperture::Aperture(std::span<const Rgb> texels, std::size_t width, std::size_t height) {
  std::vector<float> brightness(texels.size());
  double sum[3] = {0, 0, 0};  // double: sums up to a million texels
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const Rgb c(usable(texels[i].x), usable(texels[i].y), usable(texels[i].z));
    for (int k = 0; k < 3; ++k) sum[k] += c[k];
    brightness[i] = (c.x + c.y + c.z) / 3;
  }
  const double most = std::max({sum[0], sum[1], sum[2]});
  const double mean = (sum[0] + sum[1] + sum[2]) / 3;
  weights_.assign(texels.size(), Rgb(0));
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (brightness[i] > 0)
        weights_[i][k] = static_cast<float>(usable(texels[i][k]) / brightness[i] * (mean / most));
  table_ = sampling::Distribution2D(brightness, width, height);
}

Aperture::Sample Aperture::sample(const Vec2& u) const {
  if (!weights_.empty()) {
    const Vec2 uv = table_.sample(u).uv;
    const auto cell = [](float x, std::size_t n) {
      return std::min(static_cast<std::size_t>(x * static_cast<float>(n)), n - 1);
    };
    const std::size_t at =
        cell(uv.y, table_.height()) * table_.width() + cell(uv.x, table_.width());
    return {Vec2(2 * uv.x - 1, 2 * uv.y - 1), weights_[at]};
  }
  const float r = math::pow(u.x, exponent_);
  if (blades_ == 0) return {on_circle(u.y + angle_) * r, Rgb(1)};
  const float n = static_cast<float>(blades_);
  const float blade = std::min(std::floor(u.y * n), n - 1);
  const float along = u.y * n - blade;
  const Vec2 a = on_circle(angle_ + blade / n), b = on_circle(angle_ + (blade + 1) / n);
  return {(a * (1 - along) + b * along) * r, Rgb(1)};
}

}  // namespace oriel::lens
