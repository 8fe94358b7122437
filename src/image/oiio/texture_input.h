// SPDX-License-Identifier: Apache-2.0
// The image reader of textures: reads a PixelSource, and decodes integer pictures as value^gamma.
#pragma once

#include <OpenImageIO/imageio.h>

#include <span>

#include "image/pixel_source.h"

namespace oriel::oiio {

// Decoding has to precede filtering: the mean of black and white is half the light, not half the
// code value. It is therefore done in an image reader below the tile cache. Tiles are stored as
// half floats for 8-bit pictures (relative error 2^-11, less than a step of 8 bits) and as floats
// otherwise.

/// For ImageCache::add_file; the configuration contains "oriel:path" and "oriel:gamma"; gamma 1 =
/// as stored.
OIIO::ImageInput* make_texture_input();

/// Opens the files of textures; null = open_local_source.
void set_source_opener(PixelSourceOpener opener);
std::unique_ptr<PixelSource> open_source(const std::string& path);

bool is_integer(int base_type);
/// Values of integer pixels, 0 to 1, to value^gamma, except alpha.
void decode(std::span<float> values, int channels, int alpha_channel, float gamma);

}  // namespace oriel::oiio
