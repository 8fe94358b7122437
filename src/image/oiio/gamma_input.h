// SPDX-License-Identifier: Apache-2.0
// An image reader that decodes integer pictures as value^gamma while it reads.
#pragma once

#include <OpenImageIO/imageio.h>

namespace oriel::oiio {

// Decoding has to precede filtering: the mean of black and white is half the light, not half the
// code value. It is therefore done in an image reader below the tile cache. Tiles are stored as
// half floats for 8-bit pictures (relative error 2^-11, less than a step of 8 bits) and as floats
// otherwise.

/// For ImageCache::add_file; the configuration contains "oriel:path" and "oriel:gamma".
OIIO::ImageInput* make_gamma_input();

}  // namespace oriel::oiio
