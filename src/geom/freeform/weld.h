// SPDX-License-Identifier: Apache-2.0
// Edges of surfaces that come together meet in exactly the same places.
#pragma once

#include <vector>

#include "geom/freeform/surface_mesh.h"

namespace oriel::geom::freeform {

/// Moves vertices on edges that are closer than `distance` to one that came before to its place; no
/// vertices are joined, each surface keeps its normals. At least what rounding can part is joined.
void weld_edges(std::vector<SurfacePart>& parts, float distance);

}  // namespace oriel::geom::freeform
