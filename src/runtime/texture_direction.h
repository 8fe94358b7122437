// SPDX-License-Identifier: Apache-2.0
// The direction on a surface in which u of a texture space grows.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// World-space derivative of the position by the first coordinate of texture space `space`,
/// constant per flat triangle (manual 1.6.5, footnote 10).
///
/// Returns: a null vector for points that are not on a triangle, for a missing texture space, and
///          for one without area. A point without scene returns its own dpdu for space 0.
/// Checked: TextureDirection.*
Vec3 texture_direction(const ShadingPoint& point, int space);

/// The derivatives by both coordinates of a texture space, as texture_direction().
struct TextureDirections {
  Vec3 by_u{0}, by_v{0};
};
TextureDirections texture_directions(const ShadingPoint& point, int space);

}  // namespace oriel
