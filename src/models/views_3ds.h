// SPDX-License-Identifier: Apache-2.0
// Cameras and lights of 3DS files, which assimp gets wrong.
#pragma once

#include <string>

struct aiScene;

namespace oriel::models {

/// Corrects cameras and lights of a scene that assimp made of a 3DS file.
///
/// Model:   The file has their places in its own space; assimp stores these numbers in nodes that
///          stand there already, loses the direction of what is animated, takes y for up although
///          it is z, the lens for degrees and the falloff of spots for what it adds. Positions and
///          directions come out in the space of the node, cones as half angles; roll turns about
///          the direction of view. The field of view is 2400 / lens, degrees across.
/// Inputs:  bytes: of the file. What is damaged in it ends the reading; the rest stays as it is.
/// Source:  Autodesk 3D Studio File Toolkit, N_CAMERA and DL_SPOTLIGHT; 2400: lib3ds.
/// Checked: Model3ds.*
void mend_views_3ds(aiScene& model, const std::string& bytes);

}  // namespace oriel::models
