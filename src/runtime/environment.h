// SPDX-License-Identifier: Apache-2.0
// Radiance of environment shaders. lights/environment_light.h samples it.
#pragma once

#include "runtime/shader_node.h"

namespace oriel {

/// Radiance, in pixel units, of environment shaders in a direction; alpha is that of the last
/// shader. `blurred`: the ray belongs to a glossy lobe. `roughness`: see ShadingPoint.
Rgba environment_radiance(const NodeList& shaders, const World& world, const Vec3& origin,
                          const Vec3& direction, RayKind kind, bool blurred = false,
                          float roughness = 0);

}  // namespace oriel
