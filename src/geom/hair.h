// SPDX-License-Identifier: Apache-2.0
// Converts hair of a scene to round curves.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"

namespace oriel::geom {

/// Appends the hairs of `hair` and their slot to the curves of `mesh`.
///
/// Model:   degree 1 makes line segments, degrees 2 and 3 make chains of Bezier curves (degree * k
///          + 1 vertices; quadratic curves are raised to cubics). Curves are round, so
///          `approximate` is ignored. The radius is that of the vertex, else of the hair, else of
///          all; it may vary along a hair (default 1). Each field `t` begins a texture space of at
///          most three numbers; those of hairs precede those of vertices. Motion vectors are those
///          of the vertex, else of the hair. They are resampled to the largest number of steps of
///          all hairs, at most 15. User fields are ignored.
/// Errors:  OR-GEOM-023 once: hairs skipped because of too few vertices or a wrong number of
///          values.
/// Checked: Hair.*
void add_hair(Mesh& mesh, const scene::Hair& hair, Diagnostics& diagnostics);

struct Hit;
struct Placement;
struct SurfacePoint;

/// Like interpolate() for triangles: the surface point of a hair in direction hit.ng from its
/// centre line. dpdu is along the hair, dpdv around it. Skin normals are not rotated with moving
/// hair.
void interpolate_curve(const Mesh& mesh, const Hit& hit, const Placement& placement,
                       SurfacePoint& point);

}  // namespace oriel::geom
