// SPDX-License-Identifier: Apache-2.0
// How much of the light at a point other things shadow, for surfaces that only show shadows.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// Share of the light that arrives at a diffuse surface, by channel: 1 without shadows, 0 in the
/// shadow of all lights.
///
/// Model:   one sample of each light; the environment and indirect light cast no shadows here.
/// Returns: 1 where nothing can be traced (shadow rays, photons) or no light faces the surface.
/// Checked: ShadowCatchers.* in tests/analytic
Rgb lit_share(ShadingPoint& point);

}  // namespace oriel
