// SPDX-License-Identifier: Apache-2.0
// The textures of a glTF file with pictures that can be read.
#pragma once

#include <string>
#include <vector>

#include "models/gltf/buffers.h"
#include "models/gltf/plain_file.h"

namespace oriel::models::gltf {

/// Why some pictures are missing, in words, each once.
using Complaints = std::vector<std::string>;

/// Adds images, textures and samplers to the file; each keeps its index.
///
/// Model:   WebP (EXT_texture_webp) goes before the picture for programs without it; of Basis
///          Universal (KHR_texture_basisu) that other picture is taken, where there is one. URIs
///          become names of files or, where they hold data, parts of the buffer.
/// Checked: GltfPictures.*
Complaints plain_pictures(const json& root, Buffers& buffers, const std::string& folder,
                          PlainFile& file);

}  // namespace oriel::models::gltf
