// SPDX-License-Identifier: Apache-2.0
// Which way a model file is turned.
#pragma once

#include <optional>

#include "base/vec.h"

struct aiScene;

namespace oriel::models {

/// From the axes of a file to those of scenes: x to the right, y up, z to the viewer; a mirror
/// where the file's are left-handed.
///
/// Inputs:  up: the file's axis that points up, 'y' or 'z', by who knows it better than the file;
///          unset: as the file's settings say (FBX: UpAxis, FrontAxis, CoordAxis with their signs),
///          y where it says nothing or names an axis twice.
/// Source:  Autodesk FBX SDK, FbxAxisSystem and the properties of FbxGlobalSettings.
/// Checked: ModelAxes.*
Mat4 upright(const aiScene& model, std::optional<char> up);

}  // namespace oriel::models
