// SPDX-License-Identifier: Apache-2.0
// mib_ray_marcher: what a shader says along a ray, added up.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// The integral of another shader's colour over the way of a ray to the surface it meets, by the
/// trapezoid rule between places that are the closer the more their colours differ.
///
/// Model:   `num` places to begin with, both ends among them, and none farther from the next than
///          `distance`; four where neither is given. Where neighbours differ by more than
///          `contrast` in a channel the middle is asked as well, `subdiv` times over, at most 16.
///          As a volume it adds to what is behind; as a texture it is the sum alone. The shader is
///          asked at a point of the air, with the ray's direction and no surface: textures that go
///          by the point and lights know it, texture coordinates do not.
/// Source:  parameters and procedure by the vendor's page. That the weights are lengths (scene
///          units), so that a ray cut in two has the same sum, is a reading of its "weighted sum".
/// Checked: RayMarcher.* in tests/analytic.
extern const ShaderSpec kMibRayMarcher;

}  // namespace oriel
