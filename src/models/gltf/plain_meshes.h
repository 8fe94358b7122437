// SPDX-License-Identifier: Apache-2.0
// Converts the meshes of a glTF file to float data.
#pragma once

#include <string>

#include "models/gltf/buffers.h"
#include "models/gltf/plain_file.h"

namespace oriel::models::gltf {

/// Result of the conversion.
struct PlainMeshes {
  json meshes = json::array();
  std::size_t read = 0, left_out = 0;  ///< number of primitives
  std::string why;                     ///< the first reason
  std::size_t lost_triangles = 0;      ///< triangles with vertex indices out of range
};

/// Adds all meshes to the file; each keeps its index.
///
/// Model:   converts positions, normals, tangents, texture coordinates, the first set of colours
///          (with alpha), and integer vertex indices. The morph weights of the mesh are applied.
///          Primitives that cannot be read and attributes of the wrong size are skipped.
/// Source:  glTF 2.0, 3.7.2; KHR_mesh_quantization; KHR_draco_mesh_compression.
/// Checked: GltfPlain.*
PlainMeshes plain_meshes(const json& root, Buffers& buffers, PlainFile& file);

}  // namespace oriel::models::gltf
