// SPDX-License-Identifier: Apache-2.0
#include "models/vertex_colors.h"

#include <assimp/scene.h>

#include <algorithm>

namespace oriel::models {

ColorsAre colors_of(const std::string& suffix) {
  if (suffix == ".gltf" || suffix == ".glb") return ColorsAre::Light;
  if (suffix == ".ply" || suffix == ".obj" || suffix == ".off") return ColorsAre::Pictures;
  return ColorsAre::Unknown;
}

VertexColors vertex_colors(const aiScene& model, unsigned material, ColorsAre are) {
  VertexColors found;
  if (are == ColorsAre::Unknown) return found;
  for (unsigned i = 0; i < model.mNumMeshes; ++i) {
    const aiMesh& mesh = *model.mMeshes[i];
    if (mesh.mMaterialIndex != material || !mesh.HasVertexColors(0)) continue;
    found.are = are;
    const aiColor4D* const colors = mesh.mColors[0];
    found.transparent |=
        are == ColorsAre::Light && std::any_of(colors, colors + mesh.mNumVertices,
                                               [](const aiColor4D& color) { return color.a < 1; });
  }
  return found;
}

}  // namespace oriel::models
