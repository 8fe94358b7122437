// SPDX-License-Identifier: Apache-2.0
// Vertex colours of models.
#pragma once

#include <string>

struct aiScene;

namespace oriel::models {

/// How a format defines vertex colours.
enum class ColorsAre {
  Unknown,   ///< arbitrary data such as masks or weights; ignored
  Light,     ///< linear factors of the base colour (glTF)
  Pictures,  ///< surface colour, encoded like pictures: PLY, OBJ, OFF
};

/// Inputs:  suffix: in lower case, with its dot.
ColorsAre colors_of(const std::string& suffix);

/// Vertex colours of the meshes with one material.
struct VertexColors {
  ColorsAre are = ColorsAre::Unknown;  ///< Unknown if no mesh has colours
  bool transparent = false;            ///< some alpha is below 1
};
VertexColors vertex_colors(const aiScene& model, unsigned material, ColorsAre are);

}  // namespace oriel::models
