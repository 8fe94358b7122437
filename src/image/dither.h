// SPDX-License-Identifier: Apache-2.0
// Dither pattern for integer pictures. It is the same in every run, so output files are
// reproducible.
#pragma once

#include "base/fraction.h"

namespace oriel {

/// Offset of a pixel in (-0.5, 0.5) steps; neighbouring pixels get very different values.
/// Source: interleaved gradient noise, J. Jimenez, "Next Generation Post Processing in Call of
/// Duty: Advanced Warfare", SIGGRAPH 2014 course.
inline float dither_offset(int x, int y, int channel) {
  // Each channel shifts the pattern; otherwise the error would be grey.
  const float px = float(x) + 5.588238f * float(channel);
  const float py = float(y) + 5.588238f * float(channel);
  const float inner = 0.06711056f * px + 0.00583715f * py;
  const float outer = 52.9829189f * fraction(inner);
  return fraction(outer) - 0.5f;
}

}  // namespace oriel
