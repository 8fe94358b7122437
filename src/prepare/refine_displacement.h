// SPDX-License-Identifier: Apache-2.0
// Meshes are cut finer where displacement is to bring detail.
#pragma once

#include "prepare/prepare_displacement.h"
#include "scene/approximation.h"

namespace oriel {

/// Triangles of one displaced mesh; with all that stands beside them about 1.5 GB.
inline constexpr std::size_t kMaxMicroTriangles = std::size_t{8} << 20;

/// Splits the edges of displaced slots until the object's approximations are met, before its
/// vertices move.
///
/// Model:   `approximate displace` decides, for polygons without one their own `approximate`; where
///          several apply (groups, surfaces) the finest does. Parametric N halves every edge N
///          times, regular N makes N pieces of it at least. Lengths are those of the edges before
///          they move; distance and angle are measured on the displaced mesh between halvings, from
///          its normals, and ask for two halvings at least, so that there is something to measure.
///          An edge is split by its own ends alone, so that no crack can open. Polygons without
///          normals get those of their facets, so that detail is smooth within each and edges stay
///          sharp; with `nosmoothing` all of it stays faceted. `max N`: no halving of edges that
///          would make more than N triangles of the mesh. No approximation: nothing changes.
/// Inputs:  leaf: as for displace(). All instances of a mesh share its displacement.
/// Errors:  OR-RN-032 when kMaxMicroTriangles would be exceeded; the mesh stays as fine as it got.
/// Checked: DisplacementDetail.*
void refine_for_displacement(geom::Mesh& mesh, const Displacement& displacement,
                             const scene::Leaf& leaf, const scene::ApproximationContext& context,
                             const World& world, Diagnostics& diagnostics);

}  // namespace oriel
