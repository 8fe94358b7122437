// SPDX-License-Identifier: Apache-2.0
#include "sampling/windowed_distribution.h"

#include <algorithm>
#include <cmath>

namespace oriel::sampling {
namespace {

/// The cell in which the increasing function f, given at cell boundaries, reaches the target: the
/// first boundary in (first, last] with f >= target, minus one.
template <class F>
std::size_t cell_of(std::size_t first, std::size_t last, double target, const F& f) {
  // Branch-free binary search: random numbers defeat branch prediction.
  for (std::size_t left = last - first; left > 1;) {
    const std::size_t half = left / 2;
    first += f(first + half) <= target ? half : 0;
    left -= half;
  }
  return first;
}

}  // namespace

WindowedDistribution2D::WindowedDistribution2D(std::span<const float> values, std::size_t width,
                                               std::size_t height)
    : width_(width),
      height_(height),
      values_(values.begin(), values.end()),
      sums_((width + 1) * (height + 1), 0.0) {
  for (std::size_t y = 0; y < height; ++y) {
    double row = 0;
    for (std::size_t x = 0; x < width; ++x) {
      float& v = values_[y * width + x];
      if (!(v > 0) || !std::isfinite(v)) v = 0;
      row += static_cast<double>(v);
      sums_[(y + 1) * (width + 1) + x + 1] = sums_[y * (width + 1) + x + 1] + row;
    }
  }
}

WindowedDistribution2D::Place WindowedDistribution2D::place(float x, std::size_t cells) const {
  const double at = static_cast<double>(clamp01(x)) * static_cast<double>(cells);
  const std::size_t cell = std::min(static_cast<std::size_t>(at), cells - 1);
  return {cell, at - static_cast<double>(cell)};
}

/// Sum of the table left of a boundary between columns, below y.
double WindowedDistribution2D::column(std::size_t x, const Place& y) const {
  const double* low = &sums_[y.cell * (width_ + 1) + x];
  return low[0] + (low[width_ + 1] - low[0]) * y.share;
}

double WindowedDistribution2D::sum(const Place& x, const Place& y) const {
  const double left = column(x.cell, y), right = column(x.cell + 1, y);
  return left + (right - left) * x.share;
}

WindowedDistribution2D::Corners WindowedDistribution2D::corners(const Window& window) const {
  return {place(window.lo.x, width_), place(window.hi.x, width_), place(window.lo.y, height_),
          place(window.hi.y, height_)};
}

double WindowedDistribution2D::precise_integral(const Corners& at) const {
  const double all =
      (sum(at.x1, at.y1) - sum(at.x0, at.y1)) - (sum(at.x1, at.y0) - sum(at.x0, at.y0));
  return std::max(0.0, all) / static_cast<double>(width_ * height_);
}

float WindowedDistribution2D::integral(const Window& window) const {
  return static_cast<float>(precise_integral(corners(window)));
}

float WindowedDistribution2D::value(const Vec2& uv) const {
  return values_[place(uv.y, height_).cell * width_ + place(uv.x, width_).cell];
}

float WindowedDistribution2D::pdf(const Vec2& uv, const Window& window) const {
  const double all = precise_integral(corners(window));
  return all > 0 ? static_cast<float>(static_cast<double>(value(uv)) / all) : 0;
}

WindowedDistribution2D::Sample WindowedDistribution2D::sample(const Vec2& u,
                                                              const Window& window) const {
  const Corners ends = corners(window);
  const double all = precise_integral(ends);
  if (!(all > 0)) return {};
  // Along u: sum of the window rows left of a boundary.
  const auto left_of = [&](std::size_t x) { return column(x, ends.y1) - column(x, ends.y0); };
  const double first = sum(ends.x0, ends.y1) - sum(ends.x0, ends.y0);
  const double x_target =
      first + static_cast<double>(u.x) * all * static_cast<double>(width_ * height_);
  const std::size_t i = cell_of(ends.x0.cell, ends.x1.cell + 1, x_target, left_of);
  const double low = left_of(i), cell = left_of(i + 1) - low;
  const double across = cell > 0 ? (x_target - low) / cell : 0.5;
  Sample s;
  s.uv.x =
      clamp(static_cast<float>((static_cast<double>(i) + across) / static_cast<double>(width_)),
            window.lo.x, window.hi.x);
  // Along v: sum of the selected column.
  const auto below = [&](std::size_t y) {
    const double* at = &sums_[y * (width_ + 1) + i];
    return at[1] - at[0];
  };
  const auto below_at = [&](const Place& y) {
    return below(y.cell) + (below(y.cell + 1) - below(y.cell)) * y.share;
  };
  const double bottom = below_at(ends.y0);
  const double y_target = bottom + static_cast<double>(u.y) * (below_at(ends.y1) - bottom);
  const std::size_t j = cell_of(ends.y0.cell, ends.y1.cell + 1, y_target, below);
  const double step = below(j + 1) - below(j);
  const double up = step > 0 ? (y_target - below(j)) / step : 0.5;
  s.uv.y = clamp(static_cast<float>((static_cast<double>(j) + up) / static_cast<double>(height_)),
                 window.lo.y, window.hi.y);
  s.pdf = static_cast<float>(static_cast<double>(values_[j * width_ + i]) / all);
  return s;
}

}  // namespace oriel::sampling
