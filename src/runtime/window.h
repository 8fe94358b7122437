// SPDX-License-Identifier: Apache-2.0
// The part of the picture that is rendered.
#pragma once

#include "base/vec.h"

namespace oriel {

/// Pixels from the lower left corner, as in the scene language; half open.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  /// Raster position of the centre of a film pixel; film rows count from the top.
  Vec2 pixel_centre(int x, int y) const {
    return Vec2(static_cast<float>(x0 + x) + 0.5f, static_cast<float>(y1 - y) - 0.5f);
  }
  bool operator==(const Window&) const = default;
};

}  // namespace oriel
