// SPDX-License-Identifier: Apache-2.0
// Exposures that cannot show what is meant: gamma twice, units that do not fit.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "output/output.h"

namespace oriel {

/// Warns of pictures that come out wrong however well they are rendered.
///
/// Errors:  OR-RN-041 colours get gamma more than once on their way to a file that people look at:
///          by lens shaders, by output shaders, by the options. OR-RN-044 an exposure takes pixels
///          for another luminance than sun or sky (rgb_unit_conversion) put there, by a factor of
///          ten or more. OR-RN-066, once: a file of float pixels holds mapped colours.
/// Checked: ExposureCheck.* in exposure_check_test.cpp
void check_exposures(const World& world, const std::vector<PictureFile>& files,
                     Diagnostics& diagnostics);

}  // namespace oriel
