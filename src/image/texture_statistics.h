// SPDX-License-Identifier: Apache-2.0
// Statistics of texture files.
#pragma once

#include <cstdint>

namespace oriel {

/// Totals of the process.
struct TextureStatistics {
  std::int64_t files = 0;          ///< files opened as textures
  std::int64_t tile_requests = 0;  ///< a lookup requests one to eight tiles, more if anisotropic
  std::int64_t tile_misses = 0;    ///< requested tiles that had to be read
  std::int64_t bytes_read = 0;     ///< uncompressed size of the pixels read
  std::int64_t bytes_held = 0;     ///< current size of cached tiles and of pictures in memory
};

/// All values are 0 before the first file is opened.
/// Checked: FileTexture.StatisticsCountTilesThatWereRead
TextureStatistics texture_statistics();

}  // namespace oriel
