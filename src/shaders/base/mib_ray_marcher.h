// SPDX-License-Identifier: Apache-2.0
// mib_ray_marcher: integrates a shader along a ray.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Integral of another shader's colour along the ray up to its hit, by the trapezoid rule with
/// adaptive subdivision where colours differ.
///
/// Model:   starts with `num` points including both ends and with a spacing of at most `distance`;
///          four points if neither is given. If neighbours differ by more than `contrast` in a
///          channel, the middle is evaluated, recursively up to `subdiv` levels (at most 16). As a
///          volume shader the integral is added to the colour behind it; as a texture it is the
///          result. The shader is evaluated at a point in space, with the ray direction and without
///          a surface: textures based on position and lights work, texture coordinates do not.
/// Source:  parameters and procedure of the vendor's page. Its "weighted sum" is interpreted as
///          weights by length (scene units), so that splitting a ray does not change the sum.
/// Checked: RayMarcher.* in tests/analytic.
extern const ShaderSpec kMibRayMarcher;

}  // namespace oriel
