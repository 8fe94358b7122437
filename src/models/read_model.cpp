// SPDX-License-Identifier: Apache-2.0
#include "models/read_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "base/file_text.h"
#include "models/area_lights.h"
#include "models/gltf/read.h"
#include "models/ifc_text.h"
#include "models/import_view.h"
#include "models/light_units.h"
#include "models/mend_model.h"
#include "models/obj_materials.h"
#include "models/text_files.h"
#include "models/truncated.h"
#include "models/views_3ds.h"

namespace oriel::models {
namespace {

/// Smoothing angle in degrees; a guess that keeps edges of buildings sharp.
constexpr float kSmoothBelow = 45;

void set_up(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // Otherwise assimp ignores the inverse of PostRotation and applies geometric transforms to
  // children.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  // Otherwise assimp adds dummy meshes for the nodes of files without meshes.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothBelow);
}

unsigned steps_for(const std::string& suffix) {
  const unsigned steps = unsigned{aiProcess_JoinIdenticalVertices} | aiProcess_SortByPType |
                         aiProcess_GenUVCoords | aiProcess_ValidateDataStructure |
                         aiProcess_GlobalScale;
  // Formats without normals usually mean smooth surfaces up to an angle; glTF means flat ones
  // (specification, 3.7.2.1). Texture transforms of glTF are excluded, because assimp rotates them
  // about a wrong centre: see gltf/extras.h.
  return is_gltf(suffix) ? steps : steps | aiProcess_GenSmoothNormals | aiProcess_TransformUVCoords;
}

float aspect_of(const ImportOptions& options) { return options.aspect.value_or(kCameraAspect); }

/// How text files of a format are written again before assimp reads them. It refers to `options`
/// and fills `ifc`.
TextFiles::Rewrite rewriting(const std::string& suffix, const ImportOptions& options,
                             IfcText& ifc) {
  if (suffix == ".dae")
    return [&](const std::string& text) { return with_whole_cameras(text, aspect_of(options)); };
  if (suffix == ".ifc")
    return [&](const std::string& text) {
      ifc = as_ifc2x3(text);
      return ifc.text;
    };
  return {};
}

/// Reports at its end which files were not read.
class RefusedFiles {
 public:
  RefusedFiles(const ModelFiles& files, Diagnostics& diagnostics)
      : files_(files), diagnostics_(diagnostics) {}
  ~RefusedFiles() {
    for (const auto& [file, reason] : files_.refused)
      diagnostics_.warning("OR-MD-025", {},
                           fmt::format("file \"{}\" of the model is not read: {}", file, reason));
  }
  RefusedFiles(const RefusedFiles&) = delete;
  RefusedFiles& operator=(const RefusedFiles&) = delete;

 private:
  const ModelFiles& files_;
  Diagnostics& diagnostics_;
};

/// Why assimp could not read a file.
std::string reason_of(const std::string& error) {
  if (error.find("mNumMeshes is 0") != error.npos || error == "No meshes remaining")
    return "it has no surfaces that can be read";
  if (error.find("bad_alloc") != error.npos) return kTooMuchMemory;
  if (error.starts_with("Validation failed")) return "it is damaged: " + error;
  return error;
}

}  // namespace

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

ReadModel::ReadModel() = default;
ReadModel::ReadModel(ReadModel&&) noexcept = default;
ReadModel::~ReadModel() = default;

ReadModel read_model(const std::string& path, const ImportOptions& options,
                     Diagnostics& diagnostics) {
  const std::string suffix = suffix_of(path);
  const unsigned steps = steps_for(suffix);
  ReadModel result;
  const auto unreadable = [&](const std::string& why) {
    diagnostics.error("OR-MD-001", {}, fmt::format("cannot read model '{}': {}", path, why));
    return std::move(result);
  };
  if (suffix.starts_with(".usd")) {
    diagnostics.error("OR-MD-018", {}, fmt::format("'{}': USD files are not supported", path),
                      "convert it in Blender: File > Import > Universal Scene Description, then "
                      "File > Export > glTF 2.0 with cameras and punctual lights");
    return result;
  }
  ModelFiles files{options.files, path, is_gltf(suffix) ? FileUse::Asset : FileUse::Scene};
  const RefusedFiles refused(files, diagnostics);
  const std::string truncation = truncation_of(path, suffix, files);
  // A glTF text may have another fault that its reader names.
  if (!truncation.empty() && suffix != ".gltf") return unreadable(truncation);
  Assimp::Importer importer;
  set_up(importer);
  IfcText ifc;
  importer.SetIOHandler(new TextFiles(files, rewriting(suffix, options, ifc)));
  if (is_gltf(suffix)) {
    GltfModel gltf =
        read_gltf(importer, path, steps,
                  {options.aspect.value_or(0), options.seconds, options.files}, diagnostics);
    if (!gltf.scene) {
      const bool is_nested = gltf.error.find("nested") != gltf.error.npos;
      return unreadable(truncation.empty() || is_nested ? reason_of(gltf.error) : truncation);
    }
    result.extras = std::move(gltf.extras);
    std::unique_ptr<aiScene> model(importer.GetOrphanedScene());
    drop_polygons_without_area(*model, diagnostics);
    mend_light_units(*model, suffix, options.emission_scale, diagnostics);
    result.scene = std::move(model);
    return result;
  }
  bool read = importer.ReadFile(path, steps) != nullptr;
  if (!read && suffix == ".dae") {
    importer.SetIOHandler(new TextFiles(files, [&](const std::string& text) {
      return without_blanks_before_numbers(with_whole_cameras(text, aspect_of(options)));
    }));
    read = importer.ReadFile(path, steps) != nullptr;
  }
  if (!read) return unreadable(reason_of(importer.GetErrorString()));
  if (!ifc.unread.empty())
    diagnostics.warning("OR-MD-017", {},
                        fmt::format("shapes that cannot be read are skipped: {}", ifc.unread),
                        "export the model with tessellated or B-rep geometry");
  std::unique_ptr<aiScene> model(importer.GetOrphanedScene());
  drop_polygons_without_area(*model, diagnostics);
  if (suffix == ".dae") {
    show_invisible_materials(*model, diagnostics);
    widen_narrow_cameras(*model, diagnostics);
  }
  halve_cones(*model, suffix);
  if (suffix == ".obj") mend_obj_materials(*model, path, files, diagnostics);
  mend_area_lights(*model, suffix, suffix == ".dae" ? utf8_of(file_text(path)) : "", diagnostics);
  mend_light_units(*model, suffix, options.emission_scale, diagnostics);
  if (suffix == ".3ds") mend_views_3ds(*model, file_text(path));
  result.scene = std::move(model);
  return result;
}

}  // namespace oriel::models
