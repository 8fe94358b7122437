// SPDX-License-Identifier: Apache-2.0
// Tessellates the polygon groups of an object to one triangle mesh.
#pragma once

#include <cstdint>

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "scene/object.h"

namespace oriel::scene {
struct ApproximationContext;
}

namespace oriel::geom {

/// Maximum number of texture spaces of a shading point; further ones of an object are ignored.
inline constexpr std::size_t kMaxTextureSpaces = 8;

/// The polygons and surfaces of all groups of `object` as one mesh. Shared vertices stay shared;
/// duplicate vertices of a group are merged.
///
/// Model:   triangles are kept. Quads and general polygons are triangulated without new vertices,
///          so attributes interpolate between the original corners. Normals are normalised;
///          missing, null or non-finite normals become null, which selects the geometric normal at
///          that vertex. If no vertex has a normal, the column is empty. Subdivision surfaces are
///          refined by the finer of their own approximation and that of their displacement.
/// Inputs:  context: approximations of the scene for the object, and the camera.
/// Errors:  OR-GEOM-001 once per object, with the number of skipped polygons (no area, non-finite
///          or missing corners); OR-GEOM-002 for ignored texture spaces; those of subdivide() and
///          tessellate_freeform(). Never fails otherwise.
/// Checked: Tessellate.*, Subdivide.*, FreeForm.*
Mesh tessellate(const scene::Object& object, const scene::ApproximationContext& context,
                Diagnostics& diagnostics);
/// The number of triangles that tessellate() makes of the subdivision surfaces of an object,
/// without making them; some more if faces are trimmed or degenerate.
std::uint64_t subdivided_triangles(const scene::Object& object,
                                   const scene::ApproximationContext& context);
/// Tessellates an object without instance and camera.
Mesh tessellate(const scene::Object& object, Diagnostics& diagnostics);

}  // namespace oriel::geom
