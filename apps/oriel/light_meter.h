// SPDX-License-Identifier: Apache-2.0
// The exposure of a scene by a reflected-light meter.
#pragma once

#include "scene/scene.h"

namespace oriel::app {

/// The shutter (1/s) that photographs the last frame at ISO 100 and that f-number; 0 where the
/// picture is black or there is none.
///
/// Model:   a small picture by paths; the mean log luminance of blocks of its pixels, black ones
///          apart, is what a meter with the constant K = 12.5 cd/m2 s would read. Pixels are cd/m2.
/// Source:  ISO 2720:1974: L S t = K N^2.
/// Checked: ConvertTest.ItsOwnLightsAreMetered in tests/cli/convert_test.cpp
float metered_shutter(scene::Scene& scene, float f_number);

}  // namespace oriel::app
