// SPDX-License-Identifier: Apache-2.0
// Models of other programs as scenes: glTF, OBJ, FBX, Collada, IFC and what else assimp reads.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace oriel::models {

struct ImportOptions {
  /// Where textures that the model file itself holds are written; made when needed.
  std::string texture_folder;
  /// Textures are named relative to it where they lie below it; the folder of the `.mi` file.
  std::string scene_folder;
  /// Axis of the file that points up, 'y' or 'z'; unset: as its format says, else z for STL, y.
  std::optional<char> up;
  /// Width by height of the picture, for cameras that define their vertical angle (glTF, Collada);
  /// unset: that of each camera, else kCameraAspect.
  std::optional<float> aspect;
  /// Factor of the emission of materials; unset: that of the program that wrote the file.
  std::optional<float> emission_scale;
};

/// Names of what every imported scene has.
inline constexpr const char* kRootGroup = "model_root";
inline constexpr const char* kOptions = "model_options";

/// The suffix of a path in lower case, with its dot.
std::string lower_suffix(const std::string& path);

/// Reads a model file as a scene: an object for each of its meshes, an instance for each place
/// where one stands, a mia_material_x for each material, its lights and cameras, options that ask
/// for path tracing, and a render command for its first camera, if there is one.
///
/// Model:   lengths are metres where the file says its unit; y is up: see axes.h.
///          Materials: see import_material.h; cameras and lights: import_view.h. The root group
///          holds all instances.
/// Errors:  OR-MD-001 not readable, unset; OR-MD-002.. for what is left out or approximated,
///          OR-MD-012 nothing is left. Damaged files: see read_model.h.
/// Source:  assimp 5.2; glTF 2.0 specification, section 3.
/// Checked: ModelImport.*
std::optional<scene::Scene> import_model(const std::string& path, const ImportOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace oriel::models
