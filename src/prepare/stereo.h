// SPDX-License-Identifier: Apache-2.0
// Two eyes in place of one: where they stand, where they look, what their files are called.
#pragma once

#include <string>
#include <vector>

#include "runtime/camera.h"
#include "scene/element_settings.h"

namespace oriel {

enum class Eye : std::uint8_t { Middle, Left, Right };

/// The eyes that see a picture of that camera: both where it has `stereo` and an `eye separation`,
/// else the middle alone.
std::vector<Eye> eyes_of(const scene::Camera& camera);

/// Moves a placed camera to one of its eyes.
///
/// Model:   each eye stands half of `eye separation` aside, in the camera's x. `stereo offset`:
///          both look ahead. `offaxis`: the film is shifted so that what is ahead at `parallax
///          distance` falls on the same pixel of both pictures. `toein`: the eyes are turned until
///          their axes meet there. Without a distance both are as `offset`; `stereo on` is
///          `offaxis`. Orthographic cameras only turn.
/// Checked: Stereo.* in stereo_test.cpp
void take_eye(const scene::CameraSettings& settings, Eye eye, Camera& camera);

/// "room.exr" to "room_left.exr"; the middle's as it is.
std::string eye_path(const std::string& path, Eye eye);

}  // namespace oriel
