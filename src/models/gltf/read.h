// SPDX-License-Identifier: Apache-2.0
// Reads glTF files as assimp scenes.
#pragma once

#include <assimp/Importer.hpp>
#include <map>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/extras.h"
#include "models/gltf/plain.h"

namespace oriel::models {

struct GltfModel {
  const aiScene* scene = nullptr;  ///< owned by the importer; null if the file cannot be read
  std::string error;               ///< the reason if scene is null
  std::map<std::string, GltfExtras> extras;
};

/// Inputs:  steps: post-processing flags of assimp; options: as of gltf::make_plain.
/// Errors:  as gltf::make_plain.
GltfModel read_gltf(Assimp::Importer& importer, const std::string& path, unsigned steps,
                    const gltf::PlainOptions& options, Diagnostics& diagnostics);

}  // namespace oriel::models
