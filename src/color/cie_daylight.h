// SPDX-License-Identifier: Apache-2.0
// The colour of the CIE's phases of daylight by their temperature.
#pragma once

#include "base/vec.h"

namespace oriel {

/// CIE 1931 chromaticity (x, y) of daylight at a correlated colour temperature.
///
/// Inputs:  kelvin: 4000 ... 25000; what lies outside is taken as the end of the range.
/// Source:  CIE 15:2004, equations 3.3 to 3.5.
/// Checked: CieDaylight.IsD65At6504Kelvin
Vec2 cie_daylight_chromaticity(float kelvin);

/// Linear sRGB of that daylight at luminance 1; negative channels become 0 before it is scaled.
Rgb cie_daylight_color(float kelvin);

}  // namespace oriel
