// SPDX-License-Identifier: Apache-2.0
// Shadow share at a point, for surfaces that only show shadows.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// Unshadowed share of the light at a diffuse surface per channel: 1 without shadows, 0 in the
/// shadow of all lights.
///
/// Model:   one sample per light; the environment and indirect light cast no shadows.
/// Returns: 1 if no rays can be traced (shadow rays, photons) or no light faces the surface.
/// Checked: ShadowCatchers.* in tests/analytic
Rgb lit_share(ShadingPoint& point);

}  // namespace oriel
