// SPDX-License-Identifier: Apache-2.0
// What all sky shaders share: the conversion of lux to scene units, and which axis is up.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

/// Illuminance a unit conversion of 0 0 0 maps to 1 ("the amount of light on a sunny day").
inline constexpr float kSunnyDayLux = 80000;

/// Factor of lux for a `rgb_unit_conversion`.
inline Rgb unit_conversion(const Rgb& given, float multiplier = 1) {
  return (is_black(given) ? Rgb(1 / kSunnyDayLux) : given) * multiplier;
}

/// `direction` with z up. The swap mirrors, which a sky, even on both sides of its sun, never
/// shows.
inline Vec3 z_up(const Vec3& direction, bool y_is_up) {
  return y_is_up ? Vec3(direction.x, direction.z, direction.y) : direction;
}

}  // namespace oriel::sky
