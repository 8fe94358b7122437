// SPDX-License-Identifier: Apache-2.0
// Maps texture coordinates by wrap mode; used by file and memory textures.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/fraction.h"
#include "image/texture.h"

namespace oriel {

/// Maps x to [0, 1]; nullopt where the lookup is black. This is done before filtering, to keep the
/// precision of distant coordinates and integers in range.
inline std::optional<float> wrapped(float x, Wrap mode) {
  if (!std::isfinite(x)) return std::nullopt;
  switch (mode) {
    case Wrap::Black:
      if (x < 0 || x >= 1) return std::nullopt;
      return x;
    case Wrap::Periodic:
      return fraction(x);
    case Wrap::Clamp:
      return std::clamp(x, 0.0f, 1.0f);
    case Wrap::Mirror: {
      const float half = 0.5f * x;
      const float t = 2 * fraction(half);
      return t > 1 ? 2 - t : t;
    }
  }
  return std::nullopt;
}

/// Limits a derivative for filtering: NaN becomes 0, the magnitude is bounded.
inline float bounded_derivative(float d) {
  constexpr float kMax = 64;  // a footprint of 64 copies of the texture already yields its mean
  return std::isnan(d) ? 0.0f : std::clamp(d, -kMax, kMax);
}

}  // namespace oriel
