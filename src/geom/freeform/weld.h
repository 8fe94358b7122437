// SPDX-License-Identifier: Apache-2.0
// Welds the edges of adjacent surfaces.
#pragma once

#include <vector>

#include "geom/freeform/surface_mesh.h"

namespace oriel::geom::freeform {

/// Moves each edge vertex to an earlier edge vertex that is closer than `distance`. Vertices are
/// not merged, so each surface keeps its normals. The distance is at least the rounding error.
void weld_edges(std::vector<SurfacePart>& parts, float distance);

}  // namespace oriel::geom::freeform
