// SPDX-License-Identifier: Apache-2.0
#include "interactive/tile_order.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"

namespace oriel::interactive {

std::vector<int> tiles_near(const Vec2& pixel, const TileGrid& grid, std::vector<int> tiles) {
  const auto distance2 = [&](int tile) {
    const TileBounds b = grid.bounds(tile);
    const Vec2 centre(static_cast<float>(b.x0 + b.x1) / 2, static_cast<float>(b.y0 + b.y1) / 2);
    return (centre - pixel).length2();
  };
  std::stable_sort(tiles.begin(), tiles.end(),
                   [&](int a, int b) { return distance2(a) < distance2(b); });
  return tiles;
}

void for_each_tile(const std::vector<int>& tiles,
                   const std::function<void(int tile)>& render_tile) {
  // Parallel loops have no order of their own.
  std::atomic<std::size_t> next = 0;
  parallel_for(tiles.size(), [&](std::size_t) { render_tile(tiles[next++]); });
}

}  // namespace oriel::interactive
