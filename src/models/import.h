// SPDX-License-Identifier: Apache-2.0
// Imports models as scenes: glTF, OBJ, FBX, Collada, IFC and other formats of assimp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "base/file_access.h"
#include "base/vec.h"
#include "scene/scene.h"

namespace oriel::models {

/// Writes a texture that is embedded in a model into the folder for them, as a whole.
/// Inputs:  folder: created on demand.
/// Errors:  std::runtime_error with the reason.
void write_texture(const std::string& folder, const std::string& name, std::string_view content);

/// Mean of the first three channels of a picture; unset if it cannot be read or has fewer.
std::optional<Vec3> mean_color(const OpenFile& picture);

struct ImportOptions {
  /// Folder for textures embedded in the model file; created on demand.
  std::string texture_folder;
  /// Folder of the `.mi` file; textures inside are named relative to it.
  std::string scene_folder;
  /// Axis of the file that points up, 'y' or 'z'; unset: as the format defines, else z for STL and
  /// y for others.
  std::optional<char> up;
  /// Width by height of the picture, for cameras that define their vertical angle (glTF, Collada);
  /// unset: that of each camera, else kCameraAspect.
  std::optional<float> aspect;
  /// Time of the first animation of glTF files; unset: the transforms of the nodes.
  std::optional<float> seconds;
  /// Factor of the emission of materials; unset: that of the program that wrote the file.
  std::optional<float> emission_scale;
  /// Policy for files that the model names. The folder of the model is permitted in addition.
  FileAccess files = {};
  /// Replaces write_texture() for texture_folder, and mean_color(), where the process may not write
  /// or cannot decode.
  std::function<void(const std::string& name, std::string_view content)> texture_writer = {};
  std::function<std::optional<Vec3>(const std::string& path)> color_reader = {};
};

/// Names of elements in every imported scene.
inline constexpr const char* kRootGroup = "model_root";
inline constexpr const char* kOptions = "model_options";

/// The suffix of a path in lower case, with its dot.
std::string lower_suffix(const std::string& path);

/// Imports a model file as a scene: an object for each mesh, an instance for each node with a mesh,
/// a mia_material_x for each material, lights and cameras, options for path tracing, and a render
/// command for the first camera, if there is one.
///
/// Model:   lengths are metres if the file states its unit; y is up: see axes.h. Materials: see
///          import_material.h; cameras and lights: import_view.h. The root group contains all
///          instances.
/// Errors:  OR-MD-001 not readable, returns unset; OR-MD-002.. for skipped or approximated data;
///          OR-MD-012 the file has no surfaces. Damaged files: see read_model.h.
/// Source:  assimp 5.2; glTF 2.0 specification, section 3.
/// Checked: ModelImport.*
std::optional<scene::Scene> import_model(const std::string& path, const ImportOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace oriel::models
