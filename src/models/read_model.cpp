// SPDX-License-Identifier: Apache-2.0
#include "models/read_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>

#include "base/file_text.h"
#include "models/mend_model.h"
#include "models/text_files.h"
#include "models/views_3ds.h"

namespace oriel::models {
namespace {

/// Degrees between faces; a guess that keeps edges of buildings sharp.
constexpr float kSmoothBelow = 45;

void set_up(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // Else it leaves the inverse of PostRotation out and moves children by geometric transforms.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  // Else files without meshes get some that stand for the nodes.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothBelow);
}

unsigned steps_for(const std::string& suffix) {
  const unsigned steps = unsigned{aiProcess_JoinIdenticalVertices} | aiProcess_SortByPType |
                         aiProcess_GenUVCoords | aiProcess_ValidateDataStructure |
                         aiProcess_GlobalScale;
  // Formats that write no normals mean smooth surfaces, as far as they bend gently; glTF means flat
  // ones (specification, 3.7.2.1). And assimp moves glTF's texture coordinates about another place
  // than the file says: see gltf_extras.h.
  return is_gltf(suffix) ? steps : steps | aiProcess_GenSmoothNormals | aiProcess_TransformUVCoords;
}

}  // namespace

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

std::unique_ptr<const aiScene> read_model(const std::string& path, Diagnostics& diagnostics) {
  const std::string suffix = suffix_of(path);
  const unsigned steps = steps_for(suffix);
  Assimp::Importer importer;
  set_up(importer);
  importer.SetIOHandler(new TextFiles(false));
  bool read = importer.ReadFile(path, steps) != nullptr;
  if (!read && suffix == ".dae") {
    importer.SetIOHandler(new TextFiles(true));
    read = importer.ReadFile(path, steps) != nullptr;
  }
  if (!read) {
    diagnostics.error(
        "OR-MD-001", {},
        fmt::format("'{}' is no model that can be read: {}", path, importer.GetErrorString()));
    return nullptr;
  }
  std::unique_ptr<aiScene> model(importer.GetOrphanedScene());
  drop_polygons_without_area(*model, diagnostics);
  if (suffix == ".dae") show_invisible_materials(*model, diagnostics);
  if (suffix == ".3ds") mend_views_3ds(*model, file_text(path));
  return model;
}

}  // namespace oriel::models
