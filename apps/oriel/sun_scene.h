// SPDX-License-Identifier: Apache-2.0
// Sun of a place and time: as arguments name them, and in a scene's lights and skies.
#pragma once

#include <string>

#include "scene/scene.h"
#include "sky/solar_position.h"

namespace oriel::app {

/// "LAT,LON" in degrees, north and east positive; a Julian day from a time with its zone; both as
/// "LAT,LON,TIME".
///
/// Errors:  UsageError that begins with `option`.
sky::Place read_place(const std::string& option, const std::string& text);
double read_time(const std::string& option, const std::string& text);
sky::SolarPosition read_sun(const std::string& option, const std::string& text);

/// Turns the scene's suns and skies: the direction of lights with mia_physicalsun below `root`, and
/// sun_direction of every mia_physicalsky and mia_ciesky. Which axis is up they say themselves.
///
/// Inputs:  north: as direction_to_sun has it.
/// Errors:  UserError where there is neither, or where a light stands in several instances that
///          are turned against each other.
void turn_sun(scene::Scene& scene, const std::string& root, const sky::SolarPosition& sun,
              double north);

}  // namespace oriel::app
