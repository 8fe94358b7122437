// SPDX-License-Identifier: Apache-2.0
#include "render/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace oriel {
namespace {

TEST(Tiles, PartsContainEachTileOnce) {
  for (const int count : {1, 2, 3, 7, 64, 1000}) {
    const TileGrid grid(500, 333);
    std::vector<int> all;
    for (int k = 1; k <= count; ++k) {
      const std::vector<int> tiles = grid.part({k, count});
      all.insert(all.end(), tiles.begin(), tiles.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<int> expected(static_cast<std::size_t>(grid.count()));
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected) << count;
  }
}

TEST(Tiles, PixelsOfAllTilesAreThoseOfTheFilm) {
  const TileGrid grid(37, 20);
  std::vector<std::uint32_t> pixels = grid.pixels(grid.part({}));
  std::sort(pixels.begin(), pixels.end());
  ASSERT_EQ(pixels.size(), 37u * 20);
  for (std::uint32_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(pixels[i], i);
}

// Consecutive cells of a Hilbert curve share a side.
TEST(Tiles, OrderIsAHilbertCurve) {
  const TileGrid grid(16 * 32, 16 * 32);
  const std::vector<int> tiles = grid.part({});
  for (std::size_t i = 1; i < tiles.size(); ++i)
    EXPECT_EQ(
        std::abs(tiles[i] % 32 - tiles[i - 1] % 32) + std::abs(tiles[i] / 32 - tiles[i - 1] / 32),
        1)
        << i;
}

// Costs that increase across the picture, or are high in one region: the costliest part is within
// 3 % of the mean.
TEST(Tiles, PartsCostAboutTheSame) {
  const TileGrid grid(1920, 1080);
  for (const int count : {2, 3, 4, 7, 8}) {
    double most[2] = {0, 0}, sum[2] = {0, 0};
    for (int k = 1; k <= count; ++k) {
      double cost[2] = {0, 0};
      for (const int tile : grid.part({k, count})) {
        const TileBounds b = grid.bounds(tile);
        cost[0] += b.x0 + 2 * b.y0;
        cost[1] += b.x0 > 700 && b.x0 < 1100 && b.y0 > 300 && b.y0 < 800 ? 10 : 1;
      }
      for (int i = 0; i < 2; ++i) sum[i] += cost[i], most[i] = std::max(most[i], cost[i]);
    }
    for (int i = 0; i < 2; ++i) EXPECT_LT(most[i], 1.03 * sum[i] / count) << count << ' ' << i;
  }
}

TEST(Tiles, APartMayBeEmpty) {
  const TileGrid grid(20, 10);
  EXPECT_EQ(grid.part({2, 3}).size(), 1u);
  EXPECT_TRUE(grid.part({3, 3}).empty());
}

}  // namespace
}  // namespace oriel
