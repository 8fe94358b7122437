// SPDX-License-Identifier: Apache-2.0
// Any glTF 2.0 file as one that says the same without extensions of storage.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

struct Plain {
  json root;           ///< cameras, lights and materials, these with names of their own
  std::string binary;  ///< the whole as a .glb file, whose only buffer is its own
  std::string error;   ///< why there is nothing to be seen; empty: there is
};

/// assimp 5.2 takes quantized numbers for others, knows no packing but Draco's and no instances,
/// and finds no files by escaped names; of what this makes it reads everything.
///
/// Inputs:  content: of a .gltf or .glb file in `folder`, where its buffers are.
/// Returns: unset where it is no glTF 2.
/// Errors:  OR-MD-020 parts that cannot be read, OR-MD-021 unsupported required
///          extensions, OR-MD-022 pictures that cannot be read.
/// Inputs:  aspect: of the picture for cameras, 0: as the file has it; see plain_views.h.
/// Checked: GltfPlain.*
std::optional<Plain> make_plain(const std::string& content, const std::string& folder, float aspect,
                                Diagnostics& diagnostics);

}  // namespace oriel::models::gltf
