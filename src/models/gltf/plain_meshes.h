// SPDX-License-Identifier: Apache-2.0
// The meshes of a glTF file with their numbers as floats.
#pragma once

#include <string>

#include "models/gltf/buffers.h"
#include "models/gltf/plain_file.h"

namespace oriel::models::gltf {

/// What became of them.
struct PlainMeshes {
  json meshes = json::array();
  std::size_t read = 0, left_out = 0;  ///< primitives
  std::string why;                     ///< the first reason, in words
  std::size_t lost_triangles = 0;      ///< that name corners which do not exist
};

/// Adds what all meshes need to the file; each keeps its index.
///
/// Model:   positions, normals, tangents, texture coordinates and the first set of colours, which
///          get an alpha; blended by the mesh's own morph weights; corners as whole numbers.
///          Primitives that cannot be read are left out, and so are attributes that do not fit.
/// Source:  glTF 2.0, 3.7.2; KHR_mesh_quantization; KHR_draco_mesh_compression.
/// Checked: GltfPlain.*
PlainMeshes plain_meshes(const json& root, Buffers& buffers, PlainFile& file);

}  // namespace oriel::models::gltf
