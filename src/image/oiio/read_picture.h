// SPDX-License-Identifier: Apache-2.0
// Reads a whole texture file into memory.
#pragma once

#include <memory>
#include <string>

#include "image/mip_pyramid.h"
#include "image/pixel_source.h"

namespace oriel::oiio {

/// The finest level of a file with its coarser levels. Throws std::runtime_error with the reason
/// only.
///
/// Inputs:  level: the finest level, whose pixels fill the picture; format: of the same size, with
///          the first channels of the file.
std::unique_ptr<MipPyramid> read_picture(const std::string& path, const PixelLevel& level,
                                         const PictureFormat& format);

}  // namespace oriel::oiio
