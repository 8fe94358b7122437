// SPDX-License-Identifier: Apache-2.0
// Texture spaces of objects that are made of models.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"

namespace oriel::models {

/// As many as shaders can ask for.
inline constexpr std::size_t kMostTextureSpaces = 8;

/// In place of a channel: the colours of a mesh's corners, and their alpha.
inline constexpr unsigned kColorChannel = 1000, kAlphaChannel = 1001;

/// A channel of a mesh's texture coordinates, moved: (u, v) to (m0 u + m1 v + m2, m3 u + m4 v +
/// m5), v up.
struct TextureSpace {
  unsigned channel = 0;
  std::array<float, 6> move{1, 0, 0, 0, 1, 0};

  Vec3 of(const Vec3& uv) const {
    return {move[0] * uv.x + move[1] * uv.y + move[2], move[3] * uv.x + move[4] * uv.y + move[5],
            uv.z};
  }
  /// Whether u or v runs in another direction than in the mesh, or nowhere.
  bool turns() const { return move[1] != 0 || move[3] != 0 || move[0] <= 0 || move[4] <= 0; }
  bool operator==(const TextureSpace&) const = default;
};

/// What the objects that have one material need to be looked up.
struct SurfaceSpaces {
  std::vector<TextureSpace> spaces;  ///< in the order of the object's texture spaces
  bool tangents = false;  ///< the first has the mesh's tangents as its bump basis, where there are
  float color_gamma = 1;  ///< power that makes light of the mesh's colours
};

}  // namespace oriel::models
