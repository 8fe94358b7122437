// SPDX-License-Identifier: Apache-2.0
// Which way a place of the picture looks: panoramas, fisheyes, cubes and shifted lenses.
#pragma once

#include <optional>

#include "base/vec.h"

namespace oriel::lens {

// Conventions
//   Camera space: looking down -z, +y up, +x right. Places of the picture: u to the right, v up,
//   (0, 0) its lower left corner, (1, 1) the upper right one. Directions are unit.

/// The wall of a cylinder, or a sphere by longitude and latitude (equirectangular), unrolled; the
/// middle of the picture looks ahead.
///
/// Inputs:  horizontal: angle that the picture's width spans, rad. vertical: that its height spans,
///          rad, below pi on a cylinder.
/// Checked: LensProjection.* in projection_test.cpp, as all below
Vec3 cylindrical(const Vec2& uv, float horizontal, float vertical);
Vec3 spherical(const Vec2& uv, float horizontal, float vertical);

/// How the distance from the middle of a fisheye's picture grows with the angle to the axis.
/// Source: K. Miyamoto, "Fish Eye Lens", JOSA 54, 1964, and textbooks after it: r = f t, 2 f sin(t
/// / 2), 2 f tan(t / 2), f sin t.
enum class Fisheye { Equidistant, Equisolid, Stereographic, Orthographic };

/// Inputs:  place: from the middle of the picture, 1 = the rim, where the angle to the axis is
///          `half_angle` (rad; at most pi/2 for Orthographic, below pi for Stereographic).
/// Returns: nothing outside of the rim.
std::optional<Vec3> fisheye(const Vec2& place, Fisheye mapping, float half_angle);

/// How six faces lie in a picture; each is as its neighbours in the list see it.
enum class CubeLayout { Column, Row, TwoRows };

/// The faces -x, x, -y, y, -z, z: from the top down, from the left, or the first three over the
/// others; seen from inside, right side up when one looks level and turns, top and bottom as one
/// tilts the head from -z.
Vec3 cube(const Vec2& uv, CubeLayout layout);

/// The way to a place of the film of a camera whose back stands upright: a tilt of the view becomes
/// a shift of the film, so that what runs along `up` stays parallel in the picture.
///
/// Inputs:  place: of the film, from its middle, over the focal length. up: unit, not along
///          `forward`. World space, as the answer.
/// Returns: not unit; its part along the film's axis is 1.
Vec3 upright(const Vec2& place, const Vec3& forward, const Vec3& up);

}  // namespace oriel::lens
