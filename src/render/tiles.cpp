// SPDX-License-Identifier: Apache-2.0
#include "render/tiles.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace oriel {
namespace {

/// Distance along the Hilbert curve of a square with 2^levels cells per side.
std::uint64_t hilbert_distance(std::uint32_t x, std::uint32_t y, int levels) {
  std::uint64_t distance = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const std::uint32_t side = 1u << level;
    const std::uint32_t right = (x & side) != 0 ? 1 : 0, upper = (y & side) != 0 ? 1 : 0;
    distance = distance * 4 + ((3 * right) ^ upper);
    x &= side - 1, y &= side - 1;
    if (upper != 0) continue;
    if (right != 0) x = side - 1 - x, y = side - 1 - y;
    std::swap(x, y);
  }
  return distance;
}

/// The golden ratio's fraction of 2^64.
constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;

}  // namespace

TileBounds TileGrid::bounds(int tile) const {
  const int x0 = tile % across() * kTileSize, y0 = tile / across() * kTileSize;
  return {x0, y0, std::min(x0 + kTileSize, width_), std::min(y0 + kTileSize, height_)};
}

std::vector<int> TileGrid::part(const PicturePart& part) const {
  const auto longest = static_cast<std::uint32_t>(std::max({across(), down(), 1}));
  const int levels = std::bit_width(longest - 1);
  std::vector<std::pair<std::uint64_t, int>> curve;
  curve.reserve(static_cast<std::size_t>(count()));
  for (int tile = 0; tile < count(); ++tile)
    curve.emplace_back(hilbert_distance(static_cast<std::uint32_t>(tile % across()),
                                        static_cast<std::uint32_t>(tile / across()), levels),
                       tile);
  std::sort(curve.begin(), curve.end());
  std::vector<int> tiles;
  const auto parts = static_cast<std::uint64_t>(part.count);
  const auto mine = static_cast<std::uint64_t>(part.number - 1);
  for (std::uint64_t round = 0; round * parts < curve.size(); ++round) {
    const std::uint64_t turn = ((round * kGoldenRatio >> 32) * parts) >> 32;
    if (const std::uint64_t at = round * parts + (mine + parts - turn) % parts; at < curve.size())
      tiles.push_back(curve[at].second);
  }
  return tiles;
}

std::vector<std::uint32_t> TileGrid::pixels(const std::vector<int>& tiles) const {
  std::vector<std::uint32_t> pixels;
  for (const int tile : tiles) {
    const TileBounds b = bounds(tile);
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x)
        pixels.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
                         static_cast<std::uint32_t>(x));
  }
  return pixels;
}

}  // namespace oriel
