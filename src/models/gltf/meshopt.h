// SPDX-License-Identifier: Apache-2.0
// Buffer views that meshoptimizer's codecs have packed.
#pragma once

#include <string>
#include <string_view>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

/// What EXT_meshopt_compression says of a view; within the limits of the extension.
struct MeshoptStream {
  std::size_t count = 0, stride = 0;  ///< elements, and bytes of one
  enum class Mode { Attributes, Triangles, Indices } mode = Mode::Attributes;
  enum class Filter { None, Octahedral, Quaternion, Exponential } filter = Filter::None;
  std::size_t size() const { return count * stride; }
};

/// Errors:  Unreadable; `what` names the view.
MeshoptStream meshopt_stream(const json& packed, const std::string& what);

/// The view's content.
/// Errors:  Unreadable where the data is not of that kind.
/// Source:  EXT_meshopt_compression; meshoptimizer 0.18 decodes.
/// Checked: GltfMeshopt.*
std::string unpacked(const MeshoptStream& stream, std::string_view data, const std::string& what);

}  // namespace oriel::models::gltf
