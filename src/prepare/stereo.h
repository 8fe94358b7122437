// SPDX-License-Identifier: Apache-2.0
// Stereo cameras: positions and directions of both eyes, and their file names.
#pragma once

#include <string>
#include <vector>

#include "runtime/camera.h"
#include "scene/element_settings.h"

namespace oriel {

enum class Eye : std::uint8_t { Middle, Left, Right };

/// The eyes of a camera: both if it has `stereo` and an `eye separation`, otherwise only the
/// middle.
std::vector<Eye> eyes_of(const scene::Camera& camera);

/// Moves a placed camera to one of its eyes.
///
/// Model:   each eye is offset by half of `eye separation` along the camera's x. `stereo offset`:
///          parallel view directions. `offaxis`: the film is shifted so that the point ahead at
///          `parallax distance` is on the same pixel of both pictures. `toein`: the eyes are
///          rotated until their axes intersect there. Without a distance both are as `offset`;
///          `stereo on` is `offaxis`. Orthographic cameras only rotate.
/// Checked: Stereo.* in stereo_test.cpp
void take_eye(const scene::CameraSettings& settings, Eye eye, Camera& camera);

/// "room.exr" becomes "room_left.exr"; unchanged for the middle.
std::string eye_path(const std::string& path, Eye eye);

}  // namespace oriel
