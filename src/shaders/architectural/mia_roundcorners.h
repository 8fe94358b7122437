// SPDX-License-Identifier: Apache-2.0
// mia_roundcorners: edges that shade as if they were rounded.
#pragma once

#include <cstdint>

#include "runtime/shader_spec.h"

namespace oriel {

class Tracer;

// Use
//   In `overall_bump` of mia_material_x with the same bump_mode in both, so that it acts on diffuse
//   light whatever no_diffuse_bump says; or in `bump` with bump_mode 0. Only shading changes:
//   outlines, shadows and what shadow rays and photons meet keep the sharp edge.
// What it does
//   Within `radius` of an edge the normal is that of the nearest point of a cylinder that touches
//   both faces at that distance; edges may stand out or turn in, and `edges`, a parameter that the
//   manual does not have, leaves it to one of the two. Near corners the edges act together. Smooth
//   surfaces keep their normals, only creases act.

/// Edges that are rounded: of corners of boxes seen from outside, from inside, or both.
enum class Edges : std::uint8_t { All, StandingOut, TurningIn };

/// What to add to the normal n of a point for it to be rounded.
///
/// Model:   A face of unit normal m meets the point's plane at distance d. The axis of a cylinder
///          that touches both at distance r from their edge lies at height R = r / tan(a / 2) below
///          n, a being the angle between n and m (above, where the edge turns in). From it the
///          point is seen along R n + (r - d) t, t the unit part of m across n, so that n moves by
///          (1 - d / r) tan(a / 2) t = (1 - d / r) (m - (m.n) n) / (1 + m.n). At the edge that is
///          half of the angle from either face, at the radius nothing. Different edges add up,
///          which leaves corners of boxes continuous. Faces are found by 8 to 16 rays along the
///          surface, just below it and just above, in fixed directions: there is no noise.
/// Inputs:  radius: scene units. any_material: faces of other materials than the point's act too.
///          edges: the others keep the point's normal, and cost no rays.
/// Returns: world space, across n; null far from edges and where the point has no tracer.
/// Checked: RoundCorners.* in tests/analytic.
Vec3 rounding_of(const ShadingPoint& point, float radius, bool any_material,
                 Edges edges = Edges::All);

extern const ShaderSpec kMiaRoundCorners;

}  // namespace oriel
