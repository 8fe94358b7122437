// SPDX-License-Identifier: Apache-2.0
// Converts the nodes of a glTF scene, with one node per instance of EXT_mesh_gpu_instancing.
#pragma once

#include <string>

#include "models/gltf/buffers.h"

namespace oriel::models::gltf {

struct PlainNodes {
  json nodes = json::array();  ///< nodes of the file at their indices, followed by instances
  json roots = json::array();  ///< roots of the selected scene
  std::string left_out;        ///< why instances were skipped; empty if none was
};

/// Model:   uses the default scene of the file, else its first scene, else all trees. Each node is
///          visited once: a second reference (a cycle or a shared child) is dropped. Instances
///          become children of their node; the order is scale, rotation, translation.
/// Source:  glTF 2.0, 3.5; EXT_mesh_gpu_instancing.
/// Checked: GltfNodes.*
PlainNodes plain_nodes(const json& root, Buffers& buffers);

}  // namespace oriel::models::gltf
