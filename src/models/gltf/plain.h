// SPDX-License-Identifier: Apache-2.0
// Converts any glTF 2.0 file to an equivalent one without storage extensions.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/file_access.h"
#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

struct PlainOptions {
  float aspect = 0;              ///< of the picture for cameras; 0 = as in the file: plain_views.h
  std::optional<float> seconds;  ///< time of the first animation: see pose.h
  FileAccess files = {};         ///< policy for buffers in files
};

struct Plain {
  json root;           ///< cameras, lights and materials, the latter with unique names
  std::string binary;  ///< the converted file in .glb form with a single buffer
  std::string error;   ///< why nothing can be imported; empty on success
};

/// assimp 5.2 misinterprets quantized values, supports no compression except Draco and no
/// instances, and does not resolve escaped file names. It reads the result of this conversion
/// correctly.
///
/// Inputs:  content: of a .gltf or .glb file; folder: location of its buffers.
/// Returns: unset if the file is not glTF 2.0.
/// Errors:  OR-MD-020 parts that cannot be read, OR-MD-021 unsupported required
///          extensions, OR-MD-024 other extensions that are not read, OR-MD-022 images that cannot
///          be read.
/// Checked: GltfPlain.*
std::optional<Plain> make_plain(const std::string& content, const std::string& folder,
                                const PlainOptions& options, Diagnostics& diagnostics);

}  // namespace oriel::models::gltf
