// SPDX-License-Identifier: Apache-2.0
// Recomputes the exact position of a hit.
#pragma once

#include "geom/mesh.h"
#include "geom/surface.h"

namespace oriel::geom {

/// Recomputes t, u, v and ng of a hit in double precision with IEEE operations only. Embree
/// multiplies by reciprocals from the RCPPS instruction, whose last bits differ between processor
/// vendors.
///
/// Model:   triangles: Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT
///          2(1), 1997. Curves: Newton's method on the distance to the axis, starting with Embree's
///          values; if it does not converge (ends of a curve), those values are kept.
/// Inputs:  `org`, `dir`: the ray in the space of the mesh; `hit`: primitive and time, and Embree's
///          t, u, v, ng in that space.
/// Returns: ng in the space of the mesh, not normalised.
/// Checked: RefineHit.*
void refine_hit(const Mesh& mesh, const Vec3& org, const Vec3& dir, Hit& hit);

}  // namespace oriel::geom
