// SPDX-License-Identifier: Apache-2.0
#include "render/filter.h"

#include <vector>

#include "base/math.h"

namespace oriel {
namespace {

using scene::FilterKind;

/// Cells of a tabulated filter. Even, so that 0 is a border; at this number a cell is 1/256 pixel
/// of the widest default filter.
constexpr int kCells = 1024;

float mitchell(float x) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1) return (-7.0f / 3 * x * x * x + 12 * x * x - 20 * x + 32.0f / 3) / 6;
  return (7 * x * x * x - 12 * x * x + 16.0f / 3) / 6;
}

float sinc(float x) { return std::abs(x) < 1e-4f ? 1.0f : math::sin(kPi * x) / (kPi * x); }

float cell_centre(int i) { return (static_cast<float>(i) + 0.5f) * 2 / kCells - 1; }

bool is_tabulated(FilterKind kind) {
  return kind != FilterKind::Box && kind != FilterKind::Triangle;
}

}  // namespace

float filter_value(FilterKind kind, float t) {
  if (!(std::abs(t) <= 1)) return 0;
  switch (kind) {
    case FilterKind::Box:
      return 1;
    case FilterKind::Triangle:
      return 1 - std::abs(t);
    case FilterKind::Gauss:
      // exp(-x^2 / 2 sigma^2) with sigma = width / 6: t is three standard deviations at the end.
      return math::exp(-4.5f * t * t) - math::exp(-4.5f);
    case FilterKind::Mitchell:
    case FilterKind::ClipMitchell:
      return mitchell(2 * t);
    case FilterKind::Lanczos:
    case FilterKind::ClipLanczos:
      return sinc(2 * t) * sinc(t);
  }
  return 0;
}

FilterSampler::FilterSampler(const scene::PixelFilter& filter)
    : kind_(filter.kind),
      half_width_(std::max(filter.width, 0.0f) / 2, std::max(filter.height, 0.0f) / 2),
      clips_(filter.kind == FilterKind::ClipMitchell || filter.kind == FilterKind::ClipLanczos) {
  if (!is_tabulated(kind_)) return;
  std::vector<float> magnitude(kCells);
  double positive = 0, negative = 0;  // double: sums of a thousand small terms
  for (int i = 0; i < kCells; ++i) {
    const float value = filter_value(kind_, cell_centre(i));
    (value < 0 ? negative : positive) += std::abs(value);
    magnitude[static_cast<std::size_t>(i)] = std::abs(value);
  }
  magnitude_ = sampling::Distribution1D(magnitude);

  // The product over both axes is negative where exactly one of them is.
  const double plus = positive * positive + negative * negative;
  const double minus = 2 * positive * negative;
  positive_share_ = static_cast<float>(plus / (plus - minus));
  negative_share_ = static_cast<float>(minus / (plus - minus));
}

FilterSampler::Axis FilterSampler::sample_axis(float u) const {
  if (kind_ == FilterKind::Box) return {2 * u - 1, false};
  if (kind_ == FilterKind::Triangle)
    return {u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)), false};
  const auto s = magnitude_.sample(u);
  return {2 * s.x - 1, filter_value(kind_, cell_centre(static_cast<int>(s.index))) < 0};
}

FilterSampler::Offset FilterSampler::sample(Vec2 u) const {
  const Axis x = sample_axis(u.x), y = sample_axis(u.y);
  return {Vec2(x.t * half_width_.x, y.t * half_width_.y), x.negative != y.negative};
}

}  // namespace oriel
