// SPDX-License-Identifier: Apache-2.0
// Poses of glTF files: animations at a time, morph weights of nodes, and skins.
#pragma once

#include <optional>

#include "models/gltf/buffers.h"

namespace oriel::models::gltf {

/// Name of a list in a mesh: for each joint, the 16 numbers of its matrix, from the mesh to the
/// world.
inline constexpr const char* kJoints = "oriel_joints";

/// A document with a pose; unset if the file has no skins, no weights of nodes and no animation to
/// be applied.
///
/// Model:   the first animation is evaluated at `seconds`, within its length; unset: the transforms
///          and weights of the nodes. A node with a skin or weights gets its own copy of the mesh;
///          the copy of a skinned mesh has joint matrices, and a root node without a transform.
/// Errors:  Unreadable for accessors that cannot be read.
/// Source:  glTF 2.0, 3.7.3 (skins), 3.7.2.2 (morph targets), 3.11 and appendix C (animations).
/// Checked: GltfPose.*
std::optional<json> posed(const json& root, Buffers& buffers, std::optional<float> seconds);

}  // namespace oriel::models::gltf
