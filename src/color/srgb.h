// SPDX-License-Identifier: Apache-2.0
// The sRGB colour space: conversion between CIE XYZ, linear sRGB and encoded sRGB.
#pragma once

#include <algorithm>

#include "base/math.h"
#include "base/vec.h"

namespace oriel {

// Conventions
//   XYZ is stored in a Vec3; white (Y = 1) is D65, x = .3127, y = .3290.
//   Linear sRGB has the primaries of Rec. 709. All functions accept values outside 0..1.

/// Clamps a channel to a non-negative finite number.
inline float usable_light(float v) { return v > 0 ? std::min(v, 1e30f) : 0.0f; }

/// Linear sRGB of a CIE 1931 XYZ colour; negative if the colour is out of gamut.
/// Source:  IEC 61966-2-1 primaries and white; matrix computed from them with seven digits.
/// Checked: Srgb.XyzRoundTripIsIdentity, Srgb.WhiteIsD65
inline Rgb xyz_to_linear_srgb(const Vec3& xyz) {
  return Rgb(3.2409699f * xyz.x - 1.5373832f * xyz.y - 0.4986108f * xyz.z,
             -0.9692436f * xyz.x + 1.8759675f * xyz.y + 0.0415551f * xyz.z,
             0.0556301f * xyz.x - 0.2039770f * xyz.y + 1.0569715f * xyz.z);
}

/// CIE 1931 XYZ of a linear sRGB colour.
inline Vec3 linear_srgb_to_xyz(const Rgb& c) {
  return Vec3(0.4123908f * c.x + 0.3575843f * c.y + 0.1804808f * c.z,
              0.2126390f * c.x + 0.7151687f * c.y + 0.0721923f * c.z,
              0.0193308f * c.x + 0.1191948f * c.y + 0.9505322f * c.z);
}

/// sRGB transfer function: encoded value of a linear one. Odd, so negative values survive a round
/// trip.
/// Source: IEC 61966-2-1, piecewise form.
/// Checked: Srgb.MidGreyEncodesTo0461, Srgb.TransferRoundTripIsIdentity
inline float srgb_encode(float linear) {
  const float v = std::fabs(linear);
  const float e = v <= 0.0031308f ? 12.92f * v : 1.055f * math::pow(v, 1 / 2.4f) - 0.055f;
  return std::copysign(e, linear);
}

/// Linear value of an encoded one: the inverse of srgb_encode.
inline float srgb_decode(float encoded) {
  const float v = std::fabs(encoded);
  const float l = v <= 0.04045f ? v / 12.92f : math::pow((v + 0.055f) / 1.055f, 2.4f);
  return std::copysign(l, encoded);
}

inline Rgb srgb_encode(const Rgb& c) {
  return Rgb(srgb_encode(c.x), srgb_encode(c.y), srgb_encode(c.z));
}
inline Rgb srgb_decode(const Rgb& c) {
  return Rgb(srgb_decode(c.x), srgb_decode(c.y), srgb_decode(c.z));
}

}  // namespace oriel
