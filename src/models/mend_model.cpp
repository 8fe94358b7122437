// SPDX-License-Identifier: Apache-2.0
#include "models/mend_model.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace oriel::models {
namespace {

Imath::V3d corner(const aiMesh& mesh, unsigned index) {
  const aiVector3D& v = mesh.mVertices[index];
  return {v.x, v.y, v.z};
}

/// Whether all triples of vertices are collinear. In double, as in the triangulation.
bool without_area(const aiMesh& mesh, const aiFace& face) {
  if (face.mNumIndices < 3) return false;
  for (unsigned i = 0; i < face.mNumIndices; ++i)
    if (face.mIndices[i] >= mesh.mNumVertices) return false;
  const Imath::V3d first = corner(mesh, face.mIndices[0]);
  Imath::V3d along(0);
  for (unsigned i = 1; i < face.mNumIndices; ++i) {
    const Imath::V3d side = corner(mesh, face.mIndices[i]) - first;
    if (along == Imath::V3d(0))
      along = side;
    else if (!(along.cross(side) == Imath::V3d(0)))
      return false;
  }
  return true;
}

}  // namespace

void drop_polygons_without_area(aiScene& model, Diagnostics& diagnostics) {
  std::size_t dropped = 0;
  for (unsigned i = 0; i < model.mNumMeshes; ++i) {
    aiMesh& mesh = *model.mMeshes[i];
    unsigned kept = 0;
    for (unsigned k = 0; k < mesh.mNumFaces; ++k)
      if (!without_area(mesh, mesh.mFaces[k])) std::swap(mesh.mFaces[kept++], mesh.mFaces[k]);
    dropped += mesh.mNumFaces - kept;
    mesh.mNumFaces = kept;  // the array still owns the polygons beyond
  }
  if (dropped > 0)
    diagnostics.note("OR-MD-009", {}, fmt::format("zero-area polygons dropped: {}", dropped));
}

void show_invisible_materials(aiScene& model, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < model.mNumMaterials; ++i) {
    aiMaterial& material = *model.mMaterials[i];
    float opacity = 1;
    if (material.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS || opacity != 0) continue;
    const float opaque = 1;
    material.AddProperty(&opaque, 1, AI_MATKEY_OPACITY);
    names.push_back(fmt::format("\"{}\"", material.GetName().C_Str()));
  }
  if (!names.empty())
    diagnostics.note("OR-MD-010", {},
                     fmt::format("material {}: entirely transparent in the file, probably due to "
                                 "an exporter bug; imported as opaque",
                                 fmt::join(names, ", ")));
}

void widen_narrow_cameras(aiScene& model, Diagnostics& diagnostics) {
  constexpr float kNarrow = 1.5f, kDegree = kPi / 180;
  std::vector<std::string> names;
  for (unsigned i = 0; i < model.mNumCameras; ++i) {
    aiCamera& camera = *model.mCameras[i];
    const float written = camera.mHorizontalFOV / kDegree;
    if (!(written > 0 && written < kNarrow)) continue;
    camera.mHorizontalFOV = written;
    names.push_back(fmt::format("\"{}\"", camera.mName.C_Str()));
  }
  if (!names.empty())
    diagnostics.note(
        "OR-MD-014", {},
        fmt::format("camera {}: the field of view is below {} degrees; interpreted as radians",
                    fmt::join(names, ", "), kNarrow));
}

void halve_cones(aiScene& model, const std::string& suffix) {
  if (suffix != ".fbx" && suffix != ".dae") return;
  for (unsigned i = 0; i < model.mNumLights; ++i) {
    aiLight& light = *model.mLights[i];
    light.mAngleInnerCone /= 2;
    light.mAngleOuterCone = suffix == ".dae" ? light.mAngleInnerCone : light.mAngleOuterCone / 2;
  }
}

}  // namespace oriel::models
