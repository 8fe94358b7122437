// SPDX-License-Identifier: Apache-2.0
// The exposure of a scene by a reflected-light meter.
#pragma once

#include "scene/scene.h"

namespace oriel::app {

/// Shutter (1/s) that exposes the last frame correctly at ISO 100 and that f-number; 0 if the
/// picture is black or cannot be rendered.
///
/// Model:   a small path-traced picture in cd/m2. The reading is the mean log luminance of blocks
///          of its pixels without black blocks, for a meter constant K = 12.5 cd/m2 s.
/// Source:  ISO 2720:1974: L S t = K N^2.
/// Checked: ConvertTest.ItsOwnLightsAreMetered in tests/cli/convert_test.cpp
float metered_shutter(scene::Scene& scene, float f_number);

}  // namespace oriel::app
