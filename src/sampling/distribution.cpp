// SPDX-License-Identifier: Apache-2.0
#include "sampling/distribution.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "sampling/cumulative.h"

namespace oriel::sampling {
namespace {

/// Fills guide (as long as the cdf has cells) with the cell of each multiple of 1 / cells.
void build_guide(std::span<const float> cdf, std::span<std::uint32_t> guide) {
  std::uint32_t index = 0;
  for (std::size_t i = 0; i < guide.size(); ++i) {
    const float u = static_cast<float>(i) / static_cast<float>(guide.size());
    while (cdf[index + 1] <= u) ++index;
    guide[i] = index;
  }
}

/// The cell that contains u, and the position in it.
struct Cell {
  std::size_t index;
  float u;
};
/// Source: Chen, Asau, "On Generating Random Variates from an Empirical Distribution", AIIE
///         Transactions 6(2), 1974.
Cell find_cell(std::span<const float> cdf, std::span<const std::uint32_t> guide, float u) {
  const auto cells = static_cast<float>(guide.size());
  // Rounding of the product may reach the next entry.
  auto slot = std::min(static_cast<std::size_t>(u * cells), guide.size() - 1);
  if (slot > 0 && static_cast<float>(slot) / cells > u) --slot;
  std::size_t index = guide[slot];
  while (cdf[index + 1] <= u) ++index;
  const float width = cdf[index + 1] - cdf[index];
  const float inside = width > 0 ? (u - cdf[index]) / width : 0;
  return {index, clamp(inside, 0.0f, kBelowOne)};
}

float position(const Cell& cell, std::size_t count) {
  const float x = (static_cast<float>(cell.index) + cell.u) / static_cast<float>(count);
  return std::min(x, kBelowOne);
}

}  // namespace

Distribution1D::Distribution1D(std::span<const float> values)
    : values_(values.size()), cdf_(values.size() + 1), guide_(values.size()) {
  ORIEL_ASSERT(!values.empty());
  std::transform(values.begin(), values.end(), values_.begin(), usable);
  const double total = build_cdf<float>(values_, cdf_);
  build_guide(cdf_, guide_);
  integral_ = static_cast<float>(total / static_cast<double>(values_.size()));
  if (!(integral_ > 0)) std::fill(values_.begin(), values_.end(), 1.0f);
  inverse_integral_ = integral_ > 0 ? 1 / integral_ : 1;
}

Distribution1D::Sample Distribution1D::sample(float u) const {
  const Cell cell = find_cell(cdf_, guide_, u);
  return {position(cell, size()), values_[cell.index] * inverse_integral_, cell.index};
}

Distribution1D::Choice Distribution1D::choose(float u) const {
  const Cell cell = find_cell(cdf_, guide_, u);
  return {cell.index, pmf(cell.index), cell.u};
}

float Distribution1D::pdf(float x) const { return values_[cell_of(x, size())] * inverse_integral_; }

Distribution2D::Distribution2D(std::span<const float> values, std::size_t width, std::size_t height)
    : width_(width),
      height_(height),
      values_(width * height),
      row_cdf_((width + 1) * height),
      marginal_(height + 1),
      row_guide_(width * height),
      marginal_guide_(height) {
  ORIEL_ASSERT(width > 0 && height > 0 && values.size() == width * height);
  std::transform(values.begin(), values.end(), values_.begin(), usable);
  std::vector<float> row_means(height);
  for (std::size_t y = 0; y < height; ++y) {
    const auto cdf = std::span(row_cdf_).subspan(y * (width + 1), width + 1);
    const double total = build_cdf<float>(std::span(values_).subspan(y * width, width), cdf);
    build_guide(cdf, std::span(row_guide_).subspan(y * width, width));
    row_means[y] = static_cast<float>(total / static_cast<double>(width));
  }
  const double total = build_cdf<float>(row_means, marginal_);
  build_guide(marginal_, marginal_guide_);
  integral_ = static_cast<float>(total / static_cast<double>(height));
  if (!(integral_ > 0)) std::fill(values_.begin(), values_.end(), 1.0f);
  inverse_integral_ = integral_ > 0 ? 1 / integral_ : 1;
}

Distribution2D::Sample Distribution2D::sample(const Vec2& u) const {
  const Cell row = find_cell(marginal_, marginal_guide_, u.y);
  const Cell cell = find_cell(std::span(row_cdf_).subspan(row.index * (width_ + 1), width_ + 1),
                              std::span(row_guide_).subspan(row.index * width_, width_), u.x);
  const std::size_t index = row.index * width_ + cell.index;
  return {Vec2(position(cell, width_), position(row, height_)), values_[index] * inverse_integral_,
          index};
}

std::size_t Distribution2D::cell(const Vec2& uv) const {
  return cell_of(uv.y, height_) * width_ + cell_of(uv.x, width_);
}

}  // namespace oriel::sampling
