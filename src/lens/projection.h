// SPDX-License-Identifier: Apache-2.0
// Ray directions of panoramic, fisheye, cube and shift lenses.
#pragma once

#include <optional>

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Camera space: looking along -z, +y up, +x right. Picture coordinates: u to the right, v up;
//   (0, 0) is the lower left corner, (1, 1) the upper right one. Directions are unit vectors.

/// Cylindrical panorama, or equirectangular (longitude and latitude); the centre of the picture is
/// the view direction.
///
/// Inputs:  horizontal: angle of the picture width in radians. vertical: angle of the picture
///          height in radians, below pi for a cylinder.
/// Checked: LensProjection.* in projection_test.cpp; these tests also cover the functions below.
Vec3 cylindrical(const Vec2& uv, float horizontal, float vertical);
Vec3 spherical(const Vec2& uv, float horizontal, float vertical);

/// Mapping of the angle to the axis to the distance from the centre of a fisheye picture.
/// Source:  K. Miyamoto, "Fish Eye Lens", JOSA 54, 1964, and later textbooks: r = f t, 2 f sin(t /
///          2), 2 f tan(t / 2), f sin t.
enum class Fisheye { Equidistant, Equisolid, Stereographic, Orthographic };

/// Inputs:  place: relative to the centre of the picture; 1 = the rim, where the angle to the axis
///          is `half_angle` (rad; at most pi/2 for Orthographic, below pi for Stereographic).
/// Returns: unset outside of the rim.
std::optional<Vec3> fisheye(const Vec2& place, Fisheye mapping, float half_angle);

/// Arrangement of six cube faces in a picture; the orientation of each face is given below.
enum class CubeLayout { Column, Row, TwoRows };

/// The faces -x, x, -y, y, -z, z: from top to bottom, from left to right, or the first three above
/// the others. They are seen from inside: the sides upright, top and bottom as seen when tilting
/// the view from -z.
Vec3 cube(const Vec2& uv, CubeLayout layout);

/// Direction to a film position of a camera with an upright back: a tilt of the view becomes a
/// shift of the film, so that lines along `up` stay parallel in the picture.
///
/// Inputs:  place: on the film relative to its centre, divided by the focal length. up: unit, not
///          parallel to `forward`. World space, like the result.
/// Returns: not normalised; the component along the film axis is 1.
Vec3 upright(const Vec2& place, const Vec3& forward, const Vec3& up);

}  // namespace oriel::lens
