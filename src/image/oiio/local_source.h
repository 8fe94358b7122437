// SPDX-License-Identifier: Apache-2.0
// Pixels of an image file, decoded by OpenImageIO in this process.
#pragma once

#include <memory>
#include <string>

#include "image/pixel_source.h"

namespace oriel::oiio {

/// Alpha is as stored. Throws std::runtime_error with the reason only.
std::unique_ptr<PixelSource> open_local_source(const std::string& path);

}  // namespace oriel::oiio
