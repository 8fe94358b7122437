// SPDX-License-Identifier: Apache-2.0
// Tessellates the free-form surfaces of a group.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "scene/approximation.h"

namespace oriel::geom {

/// All free-form surfaces of `group` as one mesh; empty if there are none.
///
/// Model:   vertices lie on the surfaces and have normals, texture surface values, motion, and
///          derivatives (if requested or if there is no texture surface). Without an approximation,
///          a surface has kDefaultPieces pieces per degree and patch. Surfaces meet without a gap
///          if they are connected, if their common border is the same curve with the same
///          approximation, or if their edges are closer than `merge` of the group. Curves only
///          define edges of surfaces; space curves are inputs for geometry shaders.
/// Inputs:  object: provides the bases and the tagged flag.
/// Errors:  OR-GEOM-030 invalid surface, skipped; OR-GEOM-031 invalid curve, skipped with the loop
///          parts that use it; OR-GEOM-032 invalid connection; OR-GEOM-033 trims that cross each
///          other or themselves; OR-GEOM-034 the approximation requires more triangles than the
///          limit.
/// Source:  mental ray manual, .mi language reference, section "Other geometry".
/// Checked: FreeForm.*
Mesh tessellate_freeform(const scene::Object& object, const scene::PolygonGroup& group,
                         const scene::ApproximationContext& context, Diagnostics& diagnostics);

/// The language defines no default; this one looks smooth at usual sizes.
inline constexpr float kDefaultPieces = 4;

}  // namespace oriel::geom
