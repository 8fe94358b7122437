// SPDX-License-Identifier: Apache-2.0
// Meshes of models as objects.
#pragma once

#include <string>

#include "scene/scene.h"

struct aiMesh;

namespace oriel::models {

/// The mesh as an object whose polygons are as the model has them: positions, normals where there
/// are some, and all its texture coordinates. Polygons with corners that do not exist are left out.
/// Checked: ModelImport.*
scene::Object object_of(const aiMesh& mesh, std::string name);

}  // namespace oriel::models
