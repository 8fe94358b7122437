// SPDX-License-Identifier: Apache-2.0
// Coordinate system of model files.
#pragma once

#include <optional>

#include "base/vec.h"

struct aiScene;

namespace oriel::models {

/// Transform from the axes of a file to those of scenes: x right, y up, z towards the viewer. It
/// mirrors files with left-handed axes.
///
/// Inputs:  up: overrides the up axis of the file, 'y' or 'z'. Unset: as the settings of the file
///          say (FBX: UpAxis, FrontAxis, CoordAxis with their signs); y if they are missing or name
///          an axis twice.
/// Source:  Autodesk FBX SDK, FbxAxisSystem and the properties of FbxGlobalSettings.
/// Checked: ModelAxes.*
Mat4 upright(const aiScene& model, std::optional<char> up);

}  // namespace oriel::models
