// SPDX-License-Identifier: Apache-2.0
// glTF data that assimp 5.2 does not provide, or not according to the specification.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "models/gltf/json_read.h"
#include "models/texture_space.h"

namespace oriel::models {

/// Data of one material.
struct GltfExtras {
  float emissive_strength = 1;
  float specular = 1;  ///< KHR_materials_specular
  Vec3 specular_color{1};
  float anisotropy = 0;  ///< strength of KHR_materials_anisotropy
  /// rotation from the tangent in radians, counter-clockwise seen from the front
  float anisotropy_turn = 0;
  std::vector<std::string> left_out;  ///< descriptions of unsupported extensions
  /// Texture spaces, by assimp's type and index of the texture.
  std::map<std::pair<int, unsigned>, TextureSpace> spaces;
};

/// Returns the data of all materials with a unique name, by name; also under "" if the file has one
/// material.
///
/// Model:   KHR_texture_transform maps coordinates by T R S: u' = ox + sx cos u + sy sin v and v' =
///          oy - sx sin u + sy cos v with v down. The rotation follows the text and the example of
///          the extension; its GLSL code has the transposed matrix.
/// Inputs:  root: the JSON of a glTF file; any other JSON has no materials.
/// Source:  glTF 2.0; KHR_texture_transform, _materials_{emissive_strength,specular,anisotropy}.
/// Checked: GltfExtras.*
std::map<std::string, GltfExtras> gltf_extras(const gltf::json& root);

}  // namespace oriel::models
