// SPDX-License-Identifier: Apache-2.0
// Lens shaders of Oriel's own: panoramas, fisheyes, cubes, and a camera's upright back.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   As lens shaders of the camera, before lenses with depth of field and exposures. The camera's
//   place and direction count, its focal length and aperture do not (but for oriel_lens_shift).
//   Scenes declare them by `$include "oriel.mi"`.
// What they do
//   oriel_lens_panorama unrolls a sphere or a cylinder around the camera. With `vertical` 0 the
//   picture's height shows as many degrees as makes its middle square. oriel_lens_fisheye shows
//   `angle` across the circle that fits into the picture, or, `full_frame`, around it; outside is
//   black and empty. oriel_lens_cube shows six faces as mib_lookup_cube1 reads them back.
//   oriel_lens_shift moves the film without turning the camera; with `keep_verticals` the tilt of
//   the camera is taken as such a shift, so that what runs along `up` stays parallel (two-point
//   perspective) and the middle of the picture stays where it was.
// Checked: LensProjections.* in tests/camera/lens_projection_test.cpp; the forms themselves in
// lens/projection_test.cpp
extern const ShaderSpec kOrielLensPanorama;
extern const ShaderSpec kOrielLensFisheye;
extern const ShaderSpec kOrielLensCube;
extern const ShaderSpec kOrielLensShift;

}  // namespace oriel
