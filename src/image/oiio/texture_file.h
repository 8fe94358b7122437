// SPDX-License-Identifier: Apache-2.0
// File textures over OpenImageIO's texture system; lives inside the files module.
#pragma once

#include <memory>
#include <string>

#include "image/texture.h"
#include "image/texture_statistics.h"

namespace oriel::oiio {

/// Refuses what no sound picture has; throws std::runtime_error with the bare reason.
void check_size(long long width, long long height, long long channels);

/// Opens a file anew when it has changed since it was last opened (by its time stamp).
/// Throws std::runtime_error with the bare reason.
std::unique_ptr<Texture> open_texture_file(const std::string& path, float gamma);

void set_cache_megabytes(float megabytes);
TextureStatistics texture_statistics();

}  // namespace oriel::oiio
