// SPDX-License-Identifier: Apache-2.0
// What a camera of a model sees of it.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "models/daylight.h"
#include "scene/scene.h"

namespace oriel::models {

/// Whether some polygon of the model, or a part of it, is in the frame of a camera that stands
/// right below the root group. What stands before what is not asked.
/// Inputs:  placed: name of the camera's instance.
/// Checked: CameraView.*
bool sees_model(const scene::Scene& scene, const std::string& placed);

/// Has the scene render the first of its cameras that sees the model, and where there is none one
/// of our own that shows all of it; see add_camera. The others stay in the scene. A model without
/// surfaces is seen by its first.
/// Returns: whether it is a camera of the file.
/// Errors:  OR-MD-011, once, where a camera of the file is passed over.
/// Checked: CameraView.*
bool choose_camera(scene::Scene& scene, const DaylightOptions& options, Diagnostics& diagnostics);

}  // namespace oriel::models
