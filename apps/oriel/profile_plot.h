// SPDX-License-Identifier: Apache-2.0
// Polar plots of light profiles, as SVG.
#pragma once

#include <string>

#include "photometry/light_profile.h"

namespace oriel::app {

/// Intensity over the angle to nadir in the planes of C0 - C180 (drawn through) and C90 - C270
/// (dashed), with circles of candela.
std::string polar_plot(const photometry::LightProfile& profile, const std::string& title);

}  // namespace oriel::app
