// SPDX-License-Identifier: Apache-2.0
// An image reader that decodes integer pictures as value^gamma while it reads.
#pragma once

#include <OpenImageIO/imageio.h>

namespace oriel::oiio {

// Decoding has to come before filtering (the mean of black and white is half the light, not half
// the code), so it sits below the tile cache as a reader of its own. Tiles are kept as half floats
// for 8-bit pictures (relative error 2^-11, the step of 8 bits is coarser) and as floats otherwise.

/// For ImageCache::add_file; the configuration carries "oriel:path" and "oriel:gamma".
OIIO::ImageInput* make_gamma_input();

}  // namespace oriel::oiio
