// SPDX-License-Identifier: Apache-2.0
// From the free-form surfaces of a group to triangles.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "scene/approximation.h"

namespace oriel::geom {

/// All free-form surfaces of `group` as one mesh; empty when there are none.
///
/// Model:   vertices lie on the surfaces, with their normals, texture surfaces' values, derivatives
///          (where a surface asks for them or has no texture surface) and motion. Without a
///          statement a surface has kDefaultPieces pieces per degree and patch. Surfaces meet
///          without a gap where they are connected, where their common border is the same curve
///          with the same approximation, and where edges are closer than the group's `merge`.
///          Curves show only as edges of surfaces: those in space are for shaders that make
///          geometry of them.
/// Inputs:  object: its bases count, and whether it is tagged.
/// Errors:  OR-GEOM-030 a surface that does not fit together, left out; OR-GEOM-031 a curve
/// likewise,
///          with the loops' parts that use it; OR-GEOM-032 a connection that does not fit;
///          OR-GEOM-033 trims that cross each other or themselves; OR-GEOM-034 more triangles were
///          asked for than there is room for.
/// Source:  the language's reference, section "Other geometry".
/// Checked: FreeForm.*
Mesh tessellate_freeform(const scene::Object& object, const scene::PolygonGroup& group,
                         const scene::ApproximationContext& context, Diagnostics& diagnostics);

/// Smooth at usual sizes; the language leaves it open.
inline constexpr float kDefaultPieces = 4;

}  // namespace oriel::geom
