// SPDX-License-Identifier: Apache-2.0
// Decompresses Draco meshes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "models/gltf/accessor.h"

namespace oriel::models::gltf {

struct UnpackedMesh {
  std::map<std::string, Column> attributes;  ///< by name (POSITION and so on)
  std::vector<std::uint32_t> corners;        ///< vertex indices of triangles
};

/// A primitive with KHR_draco_mesh_compression; its accessors define how values are interpreted.
///
/// Errors:  Unreadable.
/// Source:  KHR_draco_mesh_compression; decoded with Draco 1.5.
/// Checked: GltfDraco.*
UnpackedMesh unpack_draco(const json& root, Buffers& buffers, const json& primitive);

}  // namespace oriel::models::gltf
