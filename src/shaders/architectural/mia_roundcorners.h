// SPDX-License-Identifier: Apache-2.0
// mia_roundcorners: shades edges as if they were rounded.
#pragma once

#include <cstdint>

#include "runtime/shader_spec.h"

namespace oriel {

class Tracer;

// Use
//   Connect it to `overall_bump` of mia_material_x with the same bump_mode in both, so that it
//   affects diffuse light regardless of no_diffuse_bump; or to `bump` with bump_mode 0. Only
//   shading changes: outlines, shadows and photon hits keep the sharp edge.
// Model
//   Within `radius` of an edge the normal is that of the nearest point on a cylinder that is
//   tangent to both faces at that distance. Edges may be convex or concave; `edges`, an extension
//   of the interface, restricts the effect to one of them. Near corners the edges combine. Smooth
//   surfaces keep their normals; only creases are rounded.

/// Edges to round: convex ones, concave ones, or both.
enum class Edges : std::uint8_t { All, StandingOut, TurningIn };

/// Vector to add to the normal n of a point to round nearby edges.
///
/// Model:   a face with unit normal m meets the tangent plane of the point at distance d. The axis
///          of a cylinder that is tangent to both at distance r from their edge is at height R = r
///          / tan(a / 2) below n, where a is the angle between n and m (above for concave edges).
///          The direction from the axis to the point is R n + (r - d) t, where t is the unit
///          component of m perpendicular to n. The displacement of n is therefore (1 - d / r) tan(a
///          / 2) t = (1 - d / r) (m - (m.n) n) / (1 + m.n). At the edge this is half the angle for
///          both faces; at the radius it is zero. Contributions of several edges are added, so
///          corners of boxes are continuous. Faces are found by 8 to 16 rays along the surface,
///          just below and just above it, in fixed directions, without noise.
/// Inputs:  radius: scene units. any_material: include faces with another material than the point.
///          edges: other edges are ignored and cost no rays.
/// Returns: world space, perpendicular to n; null far from edges and if the point has no tracer.
/// Checked: RoundCorners.* in tests/analytic.
Vec3 rounding_of(const ShadingPoint& point, float radius, bool any_material,
                 Edges edges = Edges::All);

extern const ShaderSpec kMiaRoundCorners;

}  // namespace oriel
