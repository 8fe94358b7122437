// SPDX-License-Identifier: Apache-2.0
// Selects a camera that shows the model.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "models/daylight.h"
#include "scene/scene.h"

namespace oriel::models {

/// Whether any part of a polygon of the model is in the frustum of a camera that is a direct member
/// of the root group. Occlusion is ignored.
/// Inputs:  placed: name of the camera instance.
/// Checked: CameraView.*
bool sees_model(const scene::Scene& scene, const std::string& placed);

/// Makes the scene render with its first camera that shows the model, or adds one that shows the
/// whole model; see add_camera. Other cameras stay in the scene. A model without surfaces is
/// rendered with its first camera.
/// Returns: whether the camera is from the file.
/// Errors:  OR-MD-011, once, if cameras of the file were skipped.
/// Checked: CameraView.*
bool choose_camera(scene::Scene& scene, const DaylightOptions& options, Diagnostics& diagnostics);

}  // namespace oriel::models
