// SPDX-License-Identifier: Apache-2.0
// Oriel's lens shaders: panoramas, fisheyes, cube maps, and lens shift.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Lens shaders of the camera, before lens shaders for depth of field and exposure. They use the
//   position and direction of the camera; focal length and aperture are ignored (except by
//   oriel_lens_shift). Declared by `$include "oriel.mi"`.
// Model
//   oriel_lens_panorama unrolls a sphere or a cylinder around the camera. With `vertical` 0 the
//   picture height covers the angle for which the centre has square pixels. oriel_lens_fisheye
//   covers `angle` across the inscribed circle of the picture or, with `full_frame`, the
//   circumscribed one; pixels outside are black and empty. oriel_lens_cube shows six faces in the
//   layout of mib_lookup_cube1.
//   oriel_lens_shift shifts the film without rotating the camera. With `keep_verticals` the tilt of
//   the camera is converted to a shift, so lines along `up` stay parallel (two-point perspective)
//   and the centre of the picture is unchanged.
// Checked: LensProjections.* in tests/camera/lens_projection_test.cpp; the forms themselves in
// lens/projection_test.cpp
extern const ShaderSpec kOrielLensPanorama;
extern const ShaderSpec kOrielLensFisheye;
extern const ShaderSpec kOrielLensCube;
extern const ShaderSpec kOrielLensShift;

}  // namespace oriel
