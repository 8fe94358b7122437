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

/// Index, of type aiTextureType_UNKNOWN, of a texture that assimp does not read.
enum ExtraTexture : unsigned {
  kSpecularTexture = 100,
  kSpecularColorTexture,
  kAnisotropyTexture,
  kIridescenceTexture,
  kIridescenceThicknessTexture
};

/// Data of one material.
struct GltfExtras {
  float emissive_strength = 1;
  float specular = 1;  ///< KHR_materials_specular
  Vec3 specular_color{1};
  float anisotropy = 0;  ///< strength of KHR_materials_anisotropy
  /// rotation from the tangent in radians, counter-clockwise seen from the front
  float anisotropy_turn = 0;
  float iridescence = 0;              ///< factor of KHR_materials_iridescence
  float film_ior = 1.3f;              ///< of the film
  float film_least = 100;             ///< thickness in nm where the thickness texture is 0
  float film_thickness = 400;         ///< thickness in nm where it is 1, or without that texture
  std::vector<std::string> left_out;  ///< descriptions of unsupported extensions
  /// Images of ExtraTexture as assimp names them: a path, or "*number" of an embedded image.
  std::map<unsigned, std::string> files;
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
/// Source:  glTF 2.0; KHR_texture_transform,
///          _materials_{emissive_strength,specular,anisotropy,iridescence}.
/// Checked: GltfExtras.*
std::map<std::string, GltfExtras> gltf_extras(const gltf::json& root);

}  // namespace oriel::models
