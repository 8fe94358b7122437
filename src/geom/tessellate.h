// SPDX-License-Identifier: Apache-2.0
// From a scene's polygon groups to one triangle mesh per object.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "scene/object.h"

namespace oriel::scene {
struct ApproximationContext;
}

namespace oriel::geom {

/// Texture spaces that a shading point can hold; an object's further ones are left out.
inline constexpr std::size_t kMaxTextureSpaces = 8;

/// The polygons and surfaces of all groups of `object` as one mesh; vertices stay as shared as they
/// were written, and those of a group that are written alike become one.
///
/// Model:   triangles are kept, quads and general polygons cut without new vertices, so that all
///          attributes interpolate between the corners as written. Normals become unit vectors;
///          those that are missing, null or not finite become null, and the geometric normal takes
///          their place at that vertex; where no vertex has one, the column is empty. Subdivision
///          surfaces are refined as finely as their own approximation or that of their displacement
///          asks, whichever is finer.
/// Inputs:  context: what the scene around the object says of approximations, and the camera.
/// Errors:  OR-GEOM-001 once per object, counting the polygons left out (no area, corners that are
///          not finite or do not exist); OR-GEOM-002 for texture spaces left out; those of
///          subdivide() and tessellate_freeform(). Total otherwise.
/// Checked: Tessellate.*, Subdivide.*, FreeForm.*
Mesh tessellate(const scene::Object& object, const scene::ApproximationContext& context,
                Diagnostics& diagnostics);
/// As an object without instance and camera.
Mesh tessellate(const scene::Object& object, Diagnostics& diagnostics);

}  // namespace oriel::geom
