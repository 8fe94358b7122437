// SPDX-License-Identifier: Apache-2.0
// Model files as assimp's scenes, with what it or they get wrong put right.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/extras.h"
#include "models/import.h"

struct aiScene;

namespace oriel::models {

/// The suffix of a path in lower case, with its dot.
std::string suffix_of(const std::string& path);
inline bool is_gltf(const std::string& suffix) { return suffix == ".gltf" || suffix == ".glb"; }

struct ReadModel {
  std::unique_ptr<const aiScene> scene;  ///< null: not readable
  std::map<std::string, GltfExtras> extras;

  ReadModel();
  ReadModel(ReadModel&&) noexcept;
  ~ReadModel();
};

/// Reads a model: its polygons without lines and points, lengths in metres where the file says its
/// unit.
///
/// Errors:  OR-MD-001 not readable; OR-MD-018 USD; OR-MD-009, 010, 014: see mend_model.h. A damaged
/// file can
///          end the program by a signal: assimp trusts what it reads in some places.
/// Source:  assimp 5.2.
/// Checked: ModelImport.*, ModelMend.*, ModelFbx.*
ReadModel read_model(const std::string& path, const ImportOptions& options,
                     Diagnostics& diagnostics);

}  // namespace oriel::models
