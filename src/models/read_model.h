// SPDX-License-Identifier: Apache-2.0
// Reads model files with assimp and corrects known errors of files and of assimp.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/extras.h"
#include "models/import.h"

struct aiScene;

namespace oriel::models {

/// The extension of a path in lower case, with its dot.
std::string suffix_of(const std::string& path);
inline bool is_gltf(const std::string& suffix) { return suffix == ".gltf" || suffix == ".glb"; }

inline constexpr const char* kTooMuchMemory = "it needs more memory than its reader may use";

struct ReadModel {
  std::unique_ptr<const aiScene> scene;  ///< null if the file cannot be read
  std::map<std::string, GltfExtras> extras;

  ReadModel();
  ReadModel(ReadModel&&) noexcept;
  ~ReadModel();
};

/// Reads the polygons of a model, without lines and points. Lengths are metres if the file states
/// its unit.
///
/// Errors:  OR-MD-001 not readable; OR-MD-018 USD; OR-MD-009, 010, 014: see mend_model.h. A damaged
///          file may crash the process, because assimp does not validate all of its input.
/// Source:  assimp 5.2.
/// Checked: ModelImport.*, ModelMend.*, ModelFbx.*
ReadModel read_model(const std::string& path, const ImportOptions& options,
                     Diagnostics& diagnostics);

}  // namespace oriel::models
