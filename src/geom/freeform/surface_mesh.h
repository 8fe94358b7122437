// SPDX-License-Identifier: Apache-2.0
// Tessellates one free-form surface, with all data of a shading point.
#pragma once

#include "base/diagnostic.h"
#include "geom/freeform/plane_mesh.h"

namespace oriel::geom::freeform {

struct SurfacePart {
  Mesh mesh;
  std::vector<std::uint32_t> edge;  ///< vertices on the border, trims and holes
};

struct SurfaceInput {
  const scene::Object& object;
  const scene::PolygonGroup& group;
  const scene::FreeSurface& surface;
  OutlineInput outline;
};

/// The parameter range of the surface, clipped to the range of its bases.
Range range_of(const scene::FreeSurface& surface, const SurfaceNet& net);
bool is_range(const Range& range);

SurfacePart make_surface(const SurfaceInput& input, Budget& budget, Diagnostics& diagnostics);

}  // namespace oriel::geom::freeform
