// SPDX-License-Identifier: Apache-2.0
// The position of the sun as edits of a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sky/solar_position.h"

namespace oriel::interactive {

/// Edits that turn the suns and skies: the direction of lights with mia_physicalsun below `root`,
/// `sun_direction` of mia_physicalsky and mia_ciesky in shaders and cameras, and their haze.
///
/// Inputs:  north: as in sky::direction_to_sun(); haze: unset = unchanged.
/// Returns: none if the scene has neither.
/// Checked: StudioSessionTest.DaylightIsThatOfTheProgram
std::vector<std::string> sun_edits(const scene::Scene& scene, const std::string& root,
                                   const sky::SolarPosition& sun, double north,
                                   std::optional<double> haze);

}  // namespace oriel::interactive
