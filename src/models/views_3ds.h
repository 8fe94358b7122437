// SPDX-License-Identifier: Apache-2.0
// Corrects cameras and lights of 3DS files, which assimp misreads.
#pragma once

#include <string>

struct aiScene;

namespace oriel::models {

/// Corrects cameras and lights of a scene that assimp read from a 3DS file.
///
/// Model:   positions in the file are in root space, but assimp stores them in nodes that are
///          already transformed. assimp also loses the direction of animated objects, uses y
///          instead of z as the up axis, interprets the focal length as degrees, and misreads the
///          falloff of spots. The corrected positions and directions are in node space, cone angles
///          are half angles, and roll is about the view direction. The field of view is 2400 /
///          focal length in degrees across.
/// Inputs:  bytes: content of the file. Reading stops at invalid data; the rest is unchanged.
/// Source:  Autodesk 3D Studio File Toolkit, N_CAMERA and DL_SPOTLIGHT; 2400: lib3ds.
/// Checked: Model3ds.*
void mend_views_3ds(aiScene& model, const std::string& bytes);

}  // namespace oriel::models
