// SPDX-License-Identifier: Apache-2.0
// Triangles in a surface's parameter plane, along its trims and as fine as the surface asks.
#pragma once

#include <vector>

#include "geom/freeform/outline.h"
#include "geom/mesh.h"

namespace oriel::geom::freeform {

/// Vertices in the parameter plane and triangles over them, counter-clockwise there.
struct PlaneMesh {
  std::vector<EdgePoint> vertices;
  std::vector<std::uint32_t> edge;  ///< vertices on the border, trims and holes
  std::vector<Triangle> triangles;
};

/// The range as a grid of lines, without edges of its own.
/// Inputs:  approximation: parametric or regular.
PlaneMesh grid_mesh(const OutlineInput& input, Budget& budget);

/// Whatever is inside all the outer loops and outside of the holes.
///
/// Model:   a constrained Delaunay triangulation, in a plane stretched as the surface is on
/// average,
///          of the edges and of the cells that sample_surface() makes (those of the grid's lines
///          for parametric and regular); corners too close to an edge are left out. Where no loop
///          trims, the border does. A place is inside where an odd number of trims and no hole
///          surround it.
/// Inputs:  lines: trims, holes and special curves. points: u, v of special points.
/// Returns: `crossing` counts edges that cross others and were left out.
PlaneMesh trimmed_mesh(const OutlineInput& input, const std::vector<Polyline>& lines,
                       const std::vector<EdgePoint>& points, Budget& budget, std::size_t& crossing);

}  // namespace oriel::geom::freeform
