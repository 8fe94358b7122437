// SPDX-License-Identifier: Apache-2.0
// Triangulates the parameter plane of a surface along its trims, as finely as its approximation
// requires.
#pragma once

#include <vector>

#include "geom/freeform/outline.h"
#include "geom/mesh.h"

namespace oriel::geom::freeform {

/// Vertices in the parameter plane and counter-clockwise triangles.
struct PlaneMesh {
  std::vector<EdgePoint> vertices;
  std::vector<std::uint32_t> edge;  ///< vertices on the border, trims and holes
  std::vector<Triangle> triangles;
};

/// Triangulates the range with a grid of lines, without trims.
/// Inputs:  approximation: parametric or regular.
PlaneMesh grid_mesh(const OutlineInput& input, Budget& budget);

/// Triangulates the area inside of the outer loops and outside of the holes.
///
/// Model:   a constrained Delaunay triangulation in the parameter plane, scaled by the average size
///          of the surface. Its input are the edges and the cells of sample_surface() (for
///          parametric and regular: of the grid lines); corners too close to an edge are skipped.
///          The border is the outer loop if there is no trim. A point is inside if an odd number of
///          trims and no hole contain it.
/// Inputs:  lines: trims, holes and special curves. points: u, v of special points.
/// Returns: `crossing` is the number of edges that were skipped because they cross others.
PlaneMesh trimmed_mesh(const OutlineInput& input, const std::vector<Polyline>& lines,
                       const std::vector<EdgePoint>& points, Budget& budget, std::size_t& crossing);

}  // namespace oriel::geom::freeform
