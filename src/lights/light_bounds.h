// SPDX-License-Identifier: Apache-2.0
// Bounds of lights for the light tree: position, directions and strength.
#pragma once

#include "lights/light_tree.h"

namespace oriel {

struct Light;
struct World;

/// The bounds of a light; its shader is evaluated at a few points. Portals: the mean of the
/// environment behind them.
/// Inputs:  reach: about the radius of the scene. environment: mean luminance of the environment.
/// Errors:  lights that are black there have strengths 0.
LightBounds bounds_of(const Light& light, const World& world, float reach, float environment);

}  // namespace oriel
