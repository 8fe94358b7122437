// SPDX-License-Identifier: Apache-2.0
// Where a texture coordinate lands under a wrap mode; shared by file and memory textures.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "image/texture.h"

namespace oriel {

/// The coordinate in [0, 1] that stands for x; nothing where the lookup is black. Reducing before
/// any filtering keeps the precision of coordinates far away and integers in range.
inline std::optional<float> wrapped(float x, Wrap mode) {
  if (!std::isfinite(x)) return std::nullopt;
  switch (mode) {
    case Wrap::Black:
      if (x < 0 || x >= 1) return std::nullopt;
      return x;
    case Wrap::Periodic:
      return x - std::floor(x);
    case Wrap::Clamp:
      return std::clamp(x, 0.0f, 1.0f);
    case Wrap::Mirror: {
      const float half = 0.5f * x;
      const float t = 2 * (half - std::floor(half));
      return t > 1 ? 2 - t : t;
    }
  }
  return std::nullopt;
}

/// Derivatives a filter can work with: not a number becomes 0, the rest is bounded.
inline float bounded_derivative(float d) {
  constexpr float kMost = 64;  // a footprint of 64 copies of the texture is its mean anyhow
  return std::isnan(d) ? 0.0f : std::clamp(d, -kMost, kMost);
}

}  // namespace oriel
