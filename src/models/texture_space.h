// SPDX-License-Identifier: Apache-2.0
// Texture spaces of imported objects.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"

namespace oriel::models {

/// Maximum number of texture spaces that shaders can access.
inline constexpr std::size_t kMaxTextureSpaces = 8;

/// Channel numbers for vertex colours and their alpha.
inline constexpr unsigned kColorChannel = 1000, kAlphaChannel = 1001;

/// A transformed channel of texture coordinates: (u, v) maps to (m0 u + m1 v + m2, m3 u + m4 v +
/// m5), v up.
struct TextureSpace {
  unsigned channel = 0;
  std::array<float, 6> move{1, 0, 0, 0, 1, 0};

  Vec3 of(const Vec3& uv) const {
    return {move[0] * uv.x + move[1] * uv.y + move[2], move[3] * uv.x + move[4] * uv.y + move[5],
            uv.z};
  }
  /// Whether the transform changes the direction of u or v, or is degenerate.
  bool turns() const { return move[1] != 0 || move[3] != 0 || move[0] <= 0 || move[4] <= 0; }
  bool operator==(const TextureSpace&) const = default;
};

/// Texture spaces that the objects of one material have to provide.
struct SurfaceSpaces {
  std::vector<TextureSpace> spaces;  ///< in the order of the texture spaces of the object
  /// the bump basis of the first space is the mesh tangents, if there are any
  bool tangents = false;
  float color_gamma = 1;  ///< exponent that decodes vertex colours to linear
};

}  // namespace oriel::models
