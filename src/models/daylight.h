// SPDX-License-Identifier: Apache-2.0
// Default setup for rendering a model: camera, ground, sun, sky, exposure.
#pragma once

#include <string>

#include "scene/scene.h"

namespace oriel::models {

struct DaylightOptions {
  float sun_azimuth = 135;   ///< degrees clockwise from behind the model, seen from above
  float sun_elevation = 40;  ///< degrees above the horizon
  int width = 960, height = 640;
};

/// The "sunny 16" rule at ISO 100; the shutter in 1/s.
inline constexpr float kSunnyFNumber = 16, kSunnyShutter = 100;

/// Adds a camera and makes the scene render with it: a 50 mm lens on full-frame film, looking at
/// the model from the front, right and above, as close as the model allows. +z is the front, y is
/// up. An empty model counts as a unit cube.
/// Checked: Daylight.TheWholeModelIsInTheFrame
void add_camera(scene::Scene& scene, const DaylightOptions& options);

/// Sets the resolution of the rendering camera; the horizontal field of view is unchanged.
void set_picture_size(scene::Scene& scene, int width, int height);

/// Replaces the exposure of the rendering camera by a photographic one at ISO 100; shutter in 1/s.
void add_exposure(scene::Scene& scene, float f_number, float shutter);

/// Adds grey ground under the model and the camera, a physical sun and sky, and an exposure for a
/// sunny day to the rendering camera. Pixels are cd/m2 over pi.
void add_daylight(scene::Scene& scene, const DaylightOptions& options);

/// Adds a picture of the surroundings as environment to the camera that the scene renders, and grey
/// ground.
/// Inputs:  rotation: about y, degrees.
/// Checked: ConvertTest.ASkyLightsTheModel
void add_sky(scene::Scene& scene, const std::string& picture, float rotation);

}  // namespace oriel::models
