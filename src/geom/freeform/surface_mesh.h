// SPDX-License-Identifier: Apache-2.0
// One free-form surface to triangles with all that a shading point reads.
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

/// The surface's range within what its bases cover.
Range range_of(const scene::FreeSurface& surface, const SurfaceNet& net);
bool is_range(const Range& range);

SurfacePart make_surface(const SurfaceInput& input, Budget& budget, Diagnostics& diagnostics);

}  // namespace oriel::geom::freeform
