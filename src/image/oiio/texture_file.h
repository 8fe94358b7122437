// SPDX-License-Identifier: Apache-2.0
// File textures based on OpenImageIO's texture system; part of the files module.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "image/texture.h"
#include "image/texture_statistics.h"

namespace oriel::oiio {

/// Throws std::runtime_error with the reason if the size is invalid or too large.
void check_size(long long width, long long height, long long channels);

/// Reloads the file if its time stamp has changed since it was last opened. Throws
/// std::runtime_error with the reason only, also if a tile or strip of the file, of which each
/// lookup reads whole ones, has more bytes as floats.
std::unique_ptr<Texture> open_texture_file(const std::string& path, float gamma,
                                           std::uint64_t most_tile_bytes);

void set_cache_megabytes(float pictures, float tiles);
TextureStatistics texture_statistics();

}  // namespace oriel::oiio
