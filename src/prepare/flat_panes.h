// SPDX-License-Identifier: Apache-2.0
// Finds panes of glass, which do not change the direction of light.
#pragma once

namespace oriel {

namespace geom {
struct Mesh;
}
struct World;

/// Whether a mesh is a thin slab: nearly all of its surface faces one of two opposite directions,
/// as much of it one as the other, and its thickness is small compared with its size.
bool is_flat_pane(const geom::Mesh& mesh);

/// Marks the instances of such meshes, for caustics of path-traced pictures (InstanceData). Does
/// nothing with other methods.
void mark_flat_panes(World& world);

}  // namespace oriel
