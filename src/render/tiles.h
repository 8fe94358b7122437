// SPDX-License-Identifier: Apache-2.0
// Tiles of a film, and their division into parts that are rendered separately.
#pragma once

#include <cstdint>
#include <vector>

namespace oriel {

/// Tile size in pixels: small enough for two hundred tiles in a small picture, large enough for
/// coherent rays.
inline constexpr int kTileSize = 16;

/// Maximum number of parts of a picture.
inline constexpr int kMaxParts = 100000;

/// One of several parts of a picture; the default is the whole picture.
struct PicturePart {
  int number = 1;  ///< 1 to count
  int count = 1;
  bool is_whole() const { return count == 1; }
  bool operator==(const PicturePart&) const = default;
};

/// Pixels of a tile, ends excluded.
struct TileBounds {
  int x0, y0, x1, y1;
};

/// The division of a film into tiles, numbered row by row.
class TileGrid {
 public:
  TileGrid(int width, int height) : width_(width), height_(height) {}

  int across() const { return (width_ + kTileSize - 1) / kTileSize; }
  int down() const { return (height_ + kTileSize - 1) / kTileSize; }
  int count() const { return across() * down(); }
  TileBounds bounds(int tile) const;

  /// The tiles of a part.
  ///
  /// Model:   the tiles along a Hilbert curve are dealt to the parts one by one, so every part gets
  ///          tiles of all regions of the picture and parts cost about the same. The first part of
  ///          each round of dealing moves by the golden ratio: parts that got the same place of
  ///          every square of 4^k tiles would differ at the edges of costly regions.
  /// Source:  D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", Math.
  ///          Annalen 38, 1891.
  /// Checked: Tiles.*
  std::vector<int> part(const PicturePart& part) const;

  /// The indices of all pixels of tiles, in the order of the tiles, row by row within a tile.
  std::vector<std::uint32_t> pixels(const std::vector<int>& tiles) const;

 private:
  int width_, height_;
};

}  // namespace oriel
