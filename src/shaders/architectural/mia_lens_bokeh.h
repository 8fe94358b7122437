// SPDX-License-Identifier: Apache-2.0
// mia_lens_bokeh and its predecessor physical_lens_dof: depth of field.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   A lens shader of the camera, before or after exposures. Reflections in mirrors and refracted
//   views are blurred, too. Final gather points are computed through the centre of the lens, which
//   affects their positions only.
// Model
//   Each camera sample becomes `samples` rays from points on a disc of `radius` (scene units)
//   around the camera position to the intersection of its own ray with the plane at distance
//   `plane` from the camera. A point at distance z blurs to radius * |plane - z| / z on that plane.
//   The first corner of a bladed lens is to the right for blade_angle 0 and turns to the left. A
//   `bokeh` picture covers the square around the disc. Lights behind the plane show it upright,
//   lights in front upside down. Its brightness is the transmission, its colours tint; objects in
//   focus keep their brightness in the dominant channel of the picture.
extern const ShaderSpec kMiaLensBokeh;

/// Same with a round, uniform aperture and 4 rays.
extern const ShaderSpec kPhysicalLensDof;

}  // namespace oriel
