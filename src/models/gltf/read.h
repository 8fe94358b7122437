// SPDX-License-Identifier: Apache-2.0
// glTF files as assimp's scenes.
#pragma once

#include <assimp/Importer.hpp>
#include <map>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/extras.h"

namespace oriel::models {

struct GltfModel {
  const aiScene* scene = nullptr;  ///< the importer's; null: not readable
  std::string error;               ///< then, why
  std::map<std::string, GltfExtras> extras;
};

/// Inputs:  steps: of assimp's post-processing; aspect: as of gltf::make_plain.
/// Errors:  as gltf::make_plain.
GltfModel read_gltf(Assimp::Importer& importer, const std::string& path, unsigned steps,
                    float aspect, Diagnostics& diagnostics);

}  // namespace oriel::models
