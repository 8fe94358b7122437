// SPDX-License-Identifier: Apache-2.0
// What makes a picture of a model: a camera that shows all of it, ground, sun, sky, exposure.
#pragma once

#include <string>

#include "scene/scene.h"

namespace oriel::models {

struct DaylightOptions {
  float sun_azimuth = 135;   ///< degrees clockwise from behind the model, seen from above
  float sun_elevation = 40;  ///< degrees above the horizon
  int width = 960, height = 640;
};

/// What photographers take on a sunny day at ISO 100 ("sunny 16"); the shutter in 1/s.
inline constexpr float kSunnyFNumber = 16, kSunnyShutter = 100;

/// Adds a camera with a 50 mm lens on full-frame film that looks at the model from its front, right
/// and above, as near as all of it allows; and has the scene render it. +z is the front, y is up.
/// An empty model is taken for a unit cube.
/// Checked: Daylight.TheWholeModelIsInTheFrame
void add_camera(scene::Scene& scene, const DaylightOptions& options);

/// Sets the picture of the camera that the scene renders; its width shows what it showed before.
void set_picture_size(scene::Scene& scene, int width, int height);

/// Gives the camera that the scene renders a photographic exposure at ISO 100, in place of the
/// one it had; shutter in 1/s.
void add_exposure(scene::Scene& scene, float f_number, float shutter);

/// Adds grey ground under the model and its camera, a physical sun and sky, and an exposure for a
/// sunny day to the camera that the scene renders. Pixels are cd/m2 over pi.
void add_daylight(scene::Scene& scene, const DaylightOptions& options);

/// Adds a picture of the surroundings as environment to the camera that the scene renders, and grey
/// ground.
/// Inputs:  rotation: about y, degrees.
/// Checked: ConvertTest.ASkyLightsTheModel
void add_sky(scene::Scene& scene, const std::string& picture, float rotation);

}  // namespace oriel::models
