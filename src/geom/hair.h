// SPDX-License-Identifier: Apache-2.0
// Hair of a scene becomes round curves.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"

namespace oriel::geom {

/// Adds the hairs of `hair` to the curves of `mesh`, behind all its triangles, with their slot.
///
/// Model:   degree 1 are lines, 2 and 3 chains of Bezier curves (degree * k + 1 vertices, quadratic
///          ones as the cubic they are); round, so that `approximate` has nothing to ask for. The
///          radius is that of the vertex, else of the hair, else of all; it may change along a
///          hair, and is 1 when nothing says. Each field `t` begins a texture space, of three
///          numbers at most; those of hairs come before those of vertices. Motion vectors are those
///          of the vertex, else of the hair; hairs with few go the same way in the steps of those
///          with the most, 15 at most. User fields are not read.
/// Errors:  OR-GEOM-023 once: hairs left out (too few vertices, numbers that do not come out even).
/// Checked: Hair.*
void add_hair(Mesh& mesh, const scene::Hair& hair, Diagnostics& diagnostics);

struct Hit;
struct Placement;
struct SurfacePoint;

/// As interpolate() for triangles: the point of a hair where hit.ng leaves its centre line. dpdu
/// runs along the hair, dpdv around it. Normals of the skin do not turn with hair that moves.
void interpolate_curve(const Mesh& mesh, const Hit& hit, const Placement& placement,
                       SurfacePoint& point);

}  // namespace oriel::geom
