// SPDX-License-Identifier: Apache-2.0
#include "color/cie_daylight.h"

#include <algorithm>

#include "color/luminance.h"
#include "color/srgb.h"

namespace oriel {

Vec2 cie_daylight_chromaticity(float kelvin) {
  const float t = 1e3f / clamp(kelvin, 4000, 25000);
  const float x = kelvin <= 7000 ? 0.244063f + t * (0.09911f + t * (2.9678f - t * 4.6070f))
                                 : 0.237040f + t * (0.24748f + t * (1.9018f - t * 2.0064f));
  return Vec2(x, -0.275f + x * (2.870f - x * 3.000f));
}

Rgb cie_daylight_color(float kelvin) {
  const Vec2 xy = cie_daylight_chromaticity(kelvin);
  const Rgb c = xyz_to_linear_srgb(Vec3(xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y));
  const Rgb inside(std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f));
  return inside * (1 / luminance(inside));
}

}  // namespace oriel
