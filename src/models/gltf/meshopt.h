// SPDX-License-Identifier: Apache-2.0
// Decompresses buffer views of meshoptimizer.
#pragma once

#include <string>
#include <string_view>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

/// Parameters of EXT_meshopt_compression, within the limits of the extension.
struct MeshoptStream {
  std::size_t count = 0, stride = 0;  ///< number of elements, and bytes per element
  enum class Mode { Attributes, Triangles, Indices } mode = Mode::Attributes;
  enum class Filter { None, Octahedral, Quaternion, Exponential } filter = Filter::None;
  std::size_t size() const { return count * stride; }
};

/// Errors:  Unreadable; `what` names the buffer view.
MeshoptStream meshopt_stream(const json& packed, const std::string& what);

/// The decompressed content of the buffer view.
/// Errors:  Unreadable if the data is invalid.
/// Source:  EXT_meshopt_compression; decoded with meshoptimizer 0.18.
/// Checked: GltfMeshopt.*
std::string unpacked(const MeshoptStream& stream, std::string_view data, const std::string& what);

}  // namespace oriel::models::gltf
