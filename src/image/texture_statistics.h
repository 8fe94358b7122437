// SPDX-License-Identifier: Apache-2.0
// What the cache of texture files did.
#pragma once

#include <cstdint>

namespace oriel {

/// Of the process, so far.
struct TextureStatistics {
  std::int64_t files = 0;          ///< opened as textures
  std::int64_t tile_requests = 0;  ///< each look-up needs one to eight tiles, more when anisotropic
  std::int64_t tile_misses = 0;    ///< of them: tiles that had to be read
  std::int64_t bytes_read = 0;     ///< pixels, as they were before compression
  std::int64_t bytes_held = 0;     ///< by tiles, now
};

/// Zeros while no file has been opened.
/// Checked: FileTexture.StatisticsCountTilesThatWereRead
TextureStatistics texture_statistics();

}  // namespace oriel
