// SPDX-License-Identifier: Apache-2.0
// Detects exposure errors of a scene: gamma applied twice, inconsistent units.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "output/output.h"

namespace oriel {

/// Warns about wrong exposure settings.
///
/// Errors:  OR-RN-041 gamma is applied more than once to a display file: by lens shaders, output
///          shaders or the options. OR-RN-044 the exposure assumes a luminance per pixel unit that
///          differs from that of sun or sky (rgb_unit_conversion) by a factor of ten or more.
///          OR-RN-066, once: a file of float pixels contains tone-mapped colours.
/// Checked: ExposureCheck.* in exposure_check_test.cpp
void check_exposures(const World& world, const std::vector<PictureFile>& files,
                     Diagnostics& diagnostics);

}  // namespace oriel
