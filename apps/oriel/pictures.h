// SPDX-License-Identifier: Apache-2.0
// Reading of pictures that the user names.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "image/exr.h"
#include "image/pixel_buffer.h"

namespace oriel::app {

/// Errors: UserError when there is no such file; else as read_image.
Image read_named_picture(const std::string& path);

/// The linear picture of a file: of EXR files of oriel render the beauty before lens and output
/// shaders, of others what they show. Errors as of read_named_picture().
Image read_linear_picture(const std::string& path);

/// Error of a layer that the file does not contain, with the nearest layer.
UserError missing_layer(const std::string& path, const std::string& name,
                        const std::vector<Layer>& layers);

/// Attribute of EXR files: cd/m2 of one unit of a pixel; of files with layers in lux or cd/m2.
inline constexpr const char* kUnitLuminanceKey = "oriel.unitLuminance";
inline constexpr const char* kIlluminanceLayer = "illuminance";
inline constexpr const char* kLuminanceLayer = "luminance";

/// Files that hold linear values, by their suffix.
bool is_linear_file(const std::string& path);

}  // namespace oriel::app
