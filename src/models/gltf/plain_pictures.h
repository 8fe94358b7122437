// SPDX-License-Identifier: Apache-2.0
// Converts the textures of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "models/gltf/buffers.h"
#include "models/gltf/plain_file.h"

namespace oriel::models::gltf {

/// Reasons why images are missing, without duplicates.
using Complaints = std::vector<std::string>;

/// Adds images, textures and samplers to the file; each keeps its index.
///
/// Model:   WebP (EXT_texture_webp) has priority over its fallback image. For Basis Universal
///          (KHR_texture_basisu) the fallback image is used if there is one. URIs become file names
///          or, for data URIs, parts of the buffer.
/// Checked: GltfPictures.*
Complaints plain_pictures(const json& root, Buffers& buffers, const std::string& folder,
                          PlainFile& file);

}  // namespace oriel::models::gltf
