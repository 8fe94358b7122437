// SPDX-License-Identifier: Apache-2.0
// The nodes of a glTF file's scene, with an own node for each instance of EXT_mesh_gpu_instancing.
#pragma once

#include <string>

#include "models/gltf/buffers.h"

namespace oriel::models::gltf {

struct PlainNodes {
  json nodes = json::array();  ///< at the indices of the file, instances behind them
  json roots = json::array();  ///< of the scene that is shown
  std::string left_out;        ///< why instances are missing, in words; empty: none is
};

/// Model:   the file's own scene, its first where it says none, all trees where it has no scene.
///          Nodes are reached once: what closes a circle or stands below two is left out there.
///          Instances stand below their node: first scaled, then turned, then moved.
/// Source:  glTF 2.0, 3.5; EXT_mesh_gpu_instancing.
/// Checked: GltfNodes.*
PlainNodes plain_nodes(const json& root, Buffers& buffers);

}  // namespace oriel::models::gltf
