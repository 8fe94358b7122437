// SPDX-License-Identifier: Apache-2.0
#include "sampling/facing_distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/assert.h"
#include "sampling/cumulative.h"
#include "sampling/octahedral.h"

namespace oriel::sampling {
namespace {

/// 32 blocks along the square, of six degrees: the cosine changes little over one.
constexpr unsigned kBlockBits = 5;
/// Points along an edge of the cube of normals.
constexpr std::size_t kPoints = 5;
constexpr int kHalf = 2;
/// Share of a lobe that reaches kBeyond (as a cosine) behind the surface: a normal is up to 20
/// degrees beside its rounded one, and a block is 5 degrees wide.
constexpr float kWideShare = 0.15f, kBeyond = 0.45f;

float below_one(float v) { return clamp(v, 0.0f, kBelowOne); }

/// The place of a point of the cube, whose coordinates are -kHalf to kHalf.
std::size_t place_of(int x, int y, int z) {
  constexpr int kSide = kPoints;
  const int place = ((z + kHalf) * kSide + y + kHalf) * kSide + x + kHalf;
  return static_cast<std::size_t>(place);
}

std::size_t place_of(const Vec3& normal) {
  const float largest =
      std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z), 1e-20f});
  const float scale = kHalf / largest;
  // What is not a number counts as -kHalf.
  const auto rounded = [&](float v) {
    const float place = v * scale + kHalf + 0.5f;
    return (place > 0 ? static_cast<int>(std::min(place, 2 * kHalf + 0.5f)) : 0) - kHalf;
  };
  return place_of(rounded(normal.x), rounded(normal.y), rounded(normal.z));
}

float lobe(float cosine) {
  return (1 - kWideShare) * std::max(0.0f, cosine) +
         kWideShare / (1 + kBeyond) * std::max(0.0f, cosine + kBeyond);
}

struct Interval {
  std::size_t index;
  float inside, width;
};

/// The interval of the sums that contains u. Comparing with all of them is faster than a binary
/// search, which waits for memory in each step.
Interval find_interval(const float* sums, std::size_t count, float u) {
  std::uint32_t i = 0;
  for (std::size_t k = 1; k < count; ++k) i += sums[k] <= u ? 1 : 0;
  const float width = sums[i + 1] - sums[i];
  return {i, below_one((u - sums[i]) / std::max(width, 1e-30f)), width};
}

}  // namespace

double FacingDistribution::Squares::set(std::size_t square, std::span<const float> values) {
  std::vector<double> rows(count_);
  std::vector<float> row(count_);
  for (std::size_t y = 0; y < count_; ++y) {
    for (std::size_t x = 0; x < count_; ++x) row[x] = usable(values[y * count_ + x]);
    rows[y] = build_cdf<float>(row, sums_of(square, y + 1));
  }
  return build_cdf<double>(rows, sums_of(square, 0)) / static_cast<double>(count_ * count_);
}

FacingDistribution::Squares::Choice FacingDistribution::Squares::choose(std::size_t square,
                                                                        const Vec2& u) const {
  const Interval row = find_interval(&sums_[row_of(square, 0)], count_, u.y);
  const Interval cell = find_interval(&sums_[row_of(square, row.index + 1)], count_, u.x);
  return {cell.index, row.index, Vec2(cell.inside, row.inside),
          row.width * cell.width * static_cast<float>(count_ * count_)};
}

float FacingDistribution::Squares::pdf(std::size_t square, std::size_t x, std::size_t y) const {
  const float* rows = &sums_[row_of(square, 0)];
  const float* cells = &sums_[row_of(square, y + 1)];
  return (rows[y + 1] - rows[y]) * (cells[x + 1] - cells[x]) * static_cast<float>(count_ * count_);
}

FacingDistribution::FacingDistribution(std::span<const float> values, std::size_t side)
    : side_bits_(static_cast<unsigned>(std::bit_width(side)) - 1),
      cell_bits_(side_bits_ - std::min(side_bits_, kBlockBits)) {
  ORIEL_ASSERT(std::has_single_bit(side) && values.size() == side * side);
  const std::size_t blocks = side >> cell_bits_, cells = side / blocks;
  facing_ = Squares(blocks, kPoints * kPoints * kPoints);
  within_ = Squares(cells, blocks * blocks);
  std::vector<float> of_block(cells * cells), seen(blocks * blocks);
  std::vector<double> means(seen.size());
  std::vector<Vec3> directions(seen.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const std::size_t x = i % blocks, y = i / blocks;
    for (std::size_t k = 0; k < of_block.size(); ++k)
      of_block[k] = values[(y * cells + k / cells) * side + x * cells + k % cells];
    means[i] = within_.set(i, of_block);
    const Vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    directions[i] = octahedral_direction(middle / static_cast<float>(blocks));
  }
  for (int z = -kHalf; z <= kHalf; ++z)
    for (int y = -kHalf; y <= kHalf; ++y)
      for (int x = -kHalf; x <= kHalf; ++x) {
        const bool is_null = x == 0 && y == 0 && z == 0;
        if (!is_null && std::max({std::abs(x), std::abs(y), std::abs(z)}) < kHalf) continue;
        const Vec3 point(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const Vec3 normal = is_null ? point : normalize(point);
        for (std::size_t i = 0; i < means.size(); ++i)
          seen[i] = static_cast<float>(means[i]) * (is_null ? 1 : lobe(dot(directions[i], normal)));
        facing_.set(place_of(x, y, z), seen);
      }
}

FacingDistribution::Sample FacingDistribution::sample(const Vec3& normal, const Vec2& u) const {
  const Squares::Choice block = facing_.choose(place_of(normal), u);
  const unsigned block_bits = side_bits_ - cell_bits_;
  const Squares::Choice cell = within_.choose((block.y << block_bits) + block.x, block.inside);
  const std::size_t x = (block.x << cell_bits_) + cell.x, y = (block.y << cell_bits_) + cell.y;
  const Vec2 uv = (Vec2(static_cast<float>(x), static_cast<float>(y)) + cell.inside) /
                  static_cast<float>(side());
  return {Vec2(below_one(uv.x), below_one(uv.y)), block.pdf * cell.pdf, (y << side_bits_) + x};
}

float FacingDistribution::pdf(const Vec3& normal, std::size_t cell) const {
  const std::size_t x = cell & (side() - 1), y = cell >> side_bits_;
  const std::size_t block_x = x >> cell_bits_, block_y = y >> cell_bits_;
  const std::size_t in_block = (std::size_t{1} << cell_bits_) - 1;
  return facing_.pdf(place_of(normal), block_x, block_y) *
         within_.pdf((block_y << (side_bits_ - cell_bits_)) + block_x, x & in_block, y & in_block);
}

std::size_t FacingDistribution::cell(const Vec2& uv) const {
  return (cell_of(uv.y, side()) << side_bits_) + cell_of(uv.x, side());
}

}  // namespace oriel::sampling
