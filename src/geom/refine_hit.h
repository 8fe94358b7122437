// SPDX-License-Identifier: Apache-2.0
// The exact place of a hit that Embree found.
#pragma once

#include "geom/mesh.h"
#include "geom/surface.h"

namespace oriel::geom {

/// Computes t, u, v and ng of a hit again, in double precision, with IEEE operations alone. Embree
/// multiplies by reciprocals from the RCPPS instruction, whose results differ between makers of
/// processors in the last bits.
///
/// Model:   triangles: Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT
///          2(1), 1997. Curves: Newton's method on the distance to the axis, from Embree's values;
///          where it does not converge (ends of a curve), those values stay.
/// Inputs:  `org`, `dir`: the ray in the mesh's space; `hit`: primitive and time, and Embree's t,
///          u, v, ng in that space.
/// Returns: ng is in the mesh's space, not normalised.
/// Checked: RefineHit.*
void refine_hit(const Mesh& mesh, const Vec3& org, const Vec3& dir, Hit& hit);

}  // namespace oriel::geom
