// SPDX-License-Identifier: Apache-2.0
// Bump: normals from vectors in the spaces of the manual's bump modes.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// A shading normal after one bump vector.
///
/// Inputs:  normal: unit, world; v: the vector; mode: 1-4 adds v to the normal, 5-8 replaces it, in
///          internal (= world), world, object, camera space. A null vector changes nothing: shaders
///          may move the normal themselves and return 0 0 0.
/// Returns: unit, world.
/// Source:  manual, "Bump Mapping".
Vec3 bump_normal(const ShadingPoint& point, const Vec3& normal, const Vec3& v, int mode);

/// Turns the normal just enough that the viewer is on its front side: a bumped or interpolated
/// normal that looks away would shade black.
Vec3 facing_viewer(const Vec3& normal, const ShadingPoint& point);

/// Turns the normal just enough that the mirrored view does not point into the flat triangle: what
/// glossy lobes lose below it would be a dark rim.
Vec3 reflecting_outward(const Vec3& normal, const ShadingPoint& point);

}  // namespace oriel
