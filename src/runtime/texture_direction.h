// SPDX-License-Identifier: Apache-2.0
// The direction in which a texture space's u grows along the surface.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// World-space derivative of the place by the first coordinate of texture space `space`, one for
/// each flat triangle (manual 1.6.5, footnote 10).
///
/// Returns: a null vector for points that are on no triangle, where there is no such space, and
///          where it has no area. A point without a scene answers by its own dpdu for space 0.
/// Checked: TextureDirection.*
Vec3 texture_direction(const ShadingPoint& point, int space);

}  // namespace oriel
