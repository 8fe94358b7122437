// SPDX-License-Identifier: Apache-2.0
// Meshes of models as objects.
#pragma once

#include <string>

#include "models/texture_space.h"
#include "scene/scene.h"

struct aiMesh;

namespace oriel::models {

/// The mesh as an object whose polygons are as the model has them: positions, normals where there
/// are some, the texture spaces that its material asks for and after them the coordinates that it
/// does not. Polygons with corners that do not exist are left out.
/// Checked: ModelImport.*, ModelTexture.*
scene::Object object_of(const aiMesh& mesh, std::string name, const SurfaceSpaces& surface);

}  // namespace oriel::models
