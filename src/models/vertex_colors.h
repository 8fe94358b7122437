// SPDX-License-Identifier: Apache-2.0
// Colours that the corners of a model's meshes have.
#pragma once

#include <string>

struct aiScene;

namespace oriel::models {

/// What a format means by them.
enum class ColorsAre {
  Unknown,   ///< anything: masks, weights; they are left alone
  Light,     ///< linear factors of the base colour, as glTF has them
  Pictures,  ///< the surface's colour, coded as in pictures: PLY, OBJ, OFF
};

/// Inputs:  suffix: in small letters, with its dot.
ColorsAre colors_of(const std::string& suffix);

/// Of the meshes that have one material.
struct VertexColors {
  ColorsAre are = ColorsAre::Unknown;  ///< Unknown where no mesh has colours
  bool transparent = false;            ///< some alpha is below 1
};
VertexColors vertex_colors(const aiScene& model, unsigned material, ColorsAre are);

}  // namespace oriel::models
