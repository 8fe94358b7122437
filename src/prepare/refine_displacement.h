// SPDX-License-Identifier: Apache-2.0
// Refines meshes for the detail of displacement.
#pragma once

#include "prepare/prepare_displacement.h"
#include "scene/approximation.h"

namespace oriel {

/// Maximum number of triangles of one displaced mesh; with all data per triangle about 1.5 GB.
inline constexpr std::size_t kMaxMicroTriangles = std::size_t{8} << 20;

/// Splits the edges of displaced slots until the object's approximations are met, before vertices
/// move.
///
/// Model:   `approximate displace` applies, or for polygons without one their own `approximate`; of
///          several (groups, surfaces) the finest applies. Parametric N halves every edge N times,
///          regular N makes at least N pieces of it. Lengths are those of the edges before
///          displacement; distance and angle are measured on the displaced mesh between halvings,
///          from its normals, and require at least two halvings. Whether an edge is split depends
///          on its own ends only, so that no crack can open. Polygons without normals get those of
///          their facets, so detail is smooth within each facet and edges stay sharp; with
///          `nosmoothing` the result is faceted. `max N`: no halving that would make more than N
///          triangles of the mesh. Without approximation nothing changes.
/// Inputs:  leaf: as for displace(). All instances of a mesh share its displacement.
///          most: maximum number of triangles, by the budget of the scene.
/// Returns: false if `most` would be exceeded; the mesh keeps its last refinement.
/// Errors:  OR-RN-032 if kMaxMicroTriangles would be exceeded; the same.
/// Checked: DisplacementDetail.*, Budget.*
bool refine_for_displacement(geom::Mesh& mesh, const Displacement& displacement,
                             const scene::Leaf& leaf, const scene::ApproximationContext& context,
                             const World& world, std::size_t most, Diagnostics& diagnostics);

}  // namespace oriel
