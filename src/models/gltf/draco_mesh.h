// SPDX-License-Identifier: Apache-2.0
// Meshes that Draco has packed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "models/gltf/accessor.h"

namespace oriel::models::gltf {

struct UnpackedMesh {
  std::map<std::string, Column> attributes;  ///< by their names, POSITION and so on
  std::vector<std::uint32_t> corners;        ///< of triangles
};

/// A primitive with KHR_draco_mesh_compression; numbers mean what its accessors say.
///
/// Errors:  Unreadable.
/// Source:  KHR_draco_mesh_compression; Draco 1.5 decodes.
/// Checked: GltfDraco.*
UnpackedMesh unpack_draco(const json& root, Buffers& buffers, const json& primitive);

}  // namespace oriel::models::gltf
