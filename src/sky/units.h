// SPDX-License-Identifier: Apache-2.0
// Functions shared by all sky shaders: conversion of lux to scene units, and the up axis.
#pragma once

#include "base/vec.h"

namespace oriel::sky {

/// Illuminance that a unit conversion of 0 0 0 maps to 1 ("the amount of light on a sunny day").
inline constexpr float kSunnyDayLux = 80000;

/// Factor for lux of an `rgb_unit_conversion`.
inline Rgb unit_conversion(const Rgb& given, float multiplier = 1) {
  return (is_black(given) ? Rgb(1 / kSunnyDayLux) : given) * multiplier;
}

/// `direction` with z up. Swapping y and z mirrors, which is invisible: a sky is symmetric about
/// the plane of its sun.
inline Vec3 z_up(const Vec3& direction, bool y_is_up) {
  return y_is_up ? Vec3(direction.x, direction.z, direction.y) : direction;
}

}  // namespace oriel::sky
