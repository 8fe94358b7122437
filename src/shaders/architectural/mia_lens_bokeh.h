// SPDX-License-Identifier: Apache-2.0
// mia_lens_bokeh, and physical_lens_dof before it: depth of field by rays from all over a lens.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   As a lens shader of the camera, before or after exposures. Reflections in mirrors and what is
//   seen through glass are blurred as well; final gathering places its points through the lens'
//   middle, which changes where they lie but not what is seen.
// What it does
//   Each camera sample becomes `samples` rays from points of a disc of `radius` (scene units)
//   across the camera's place, towards where its own ray meets the plane at distance `plane` in
//   front of the camera. A point at distance z blurs to radius * |plane - z| / z on that plane.
//   The first corner of a bladed lens lies to the right at blade_angle 0 and turns to the left.
//   A `bokeh` picture spans the square around the disc; lights behind the plane show it upright,
//   lights before it upside down. Its brightness says where light passes, its colours tint; what is
//   sharp keeps its brightness in the channel that the picture has most of.
extern const ShaderSpec kMiaLensBokeh;

/// The same with an even, round opening and 4 rays.
extern const ShaderSpec kPhysicalLensDof;

}  // namespace oriel
