// SPDX-License-Identifier: Apache-2.0
// Tiles near the pointer first.
#pragma once

#include <functional>
#include <vector>

#include "base/vec.h"
#include "render/tiles.h"

namespace oriel::interactive {

/// The tiles by their distance from a pixel; tiles of the same distance in the given order.
/// Inputs:  pixel: of the film, from the lower left; outside of it as well.
/// Checked: TileOrder.* in tests/interactive
std::vector<int> tiles_near(const Vec2& pixel, const TileGrid& grid, std::vector<int> tiles);

/// Calls the function for each tile, concurrently; tiles start in the given order.
void for_each_tile(const std::vector<int>& tiles, const std::function<void(int tile)>& render_tile);

}  // namespace oriel::interactive
