// SPDX-License-Identifier: Apache-2.0
// Colour of CIE daylight by correlated colour temperature.
#pragma once

#include "base/vec.h"

namespace oriel {

/// CIE 1931 chromaticity (x, y) of daylight at a correlated colour temperature.
///
/// Inputs:  kelvin: clamped to 4000 ... 25000.
/// Source:  CIE 15:2004, equations 3.3 to 3.5.
/// Checked: CieDaylight.IsD65At6504Kelvin
Vec2 cie_daylight_chromaticity(float kelvin);

/// Linear sRGB of CIE daylight at luminance 1; negative channels are clamped to 0 before scaling.
Rgb cie_daylight_color(float kelvin);

}  // namespace oriel
