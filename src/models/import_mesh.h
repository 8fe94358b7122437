// SPDX-License-Identifier: Apache-2.0
// Imports meshes as objects.
#pragma once

#include <string>

#include "models/texture_space.h"
#include "scene/scene.h"

struct aiMesh;

namespace oriel::models {

/// Converts a mesh with its polygons unchanged: positions, normals if present, the texture spaces
/// of its material, then the remaining texture coordinates. Polygons with invalid vertex indices
/// are dropped.
/// Checked: ModelImport.*, ModelTexture.*
scene::Object object_of(const aiMesh& mesh, std::string name, const SurfaceSpaces& surface);

}  // namespace oriel::models
