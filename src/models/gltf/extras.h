// SPDX-License-Identifier: Apache-2.0
// What glTF files say that assimp 5.2 does not pass on, or not as the specification has it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "models/gltf/json_read.h"
#include "models/texture_space.h"

namespace oriel::models {

/// Of one material.
struct GltfExtras {
  float emissive_strength = 1;
  float specular = 1;  ///< KHR_materials_specular
  Vec3 specular_color{1};
  float anisotropy = 0;       ///< KHR_materials_anisotropy, its strength
  float anisotropy_turn = 0;  ///< from the tangent, counter-clockwise seen from the front, radians
  std::vector<std::string> left_out;  ///< in words, of extensions that nothing stands for
  /// Where textures are looked up, by assimp's type and index of the use.
  std::map<std::pair<int, unsigned>, TextureSpace> spaces;
};

/// The materials of a glTF file that have a name of their own, by it; that of a file with one
/// material under "" as well.
///
/// Model:   KHR_texture_transform moves coordinates by T R S, u' = ox + sx cos u + sy sin v and
///          v' = oy - sx sin u + sy cos v with v down, turned as the extension's text and example
///          say: its line of GLSL has the matrix the other way round.
/// Inputs:  root: a glTF file's text; whatever else it is, it has no materials.
/// Source:  glTF 2.0; KHR_texture_transform, _materials_{emissive_strength,specular,anisotropy}.
/// Checked: GltfExtras.*
std::map<std::string, GltfExtras> gltf_extras(const gltf::json& root);

}  // namespace oriel::models
