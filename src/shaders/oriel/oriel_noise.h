// SPDX-License-Identifier: Apache-2.0
// oriel_noise: sums of gradient noise, as Blender's noise and Musgrave textures.
#pragma once

#include "runtime/shader_spec.h"
#include "sampling/hashed_noise.h"

namespace oriel {

// Use
//   Textures of modelling programs. Declared by `$include "oriel.mi"`.
// Model
//   n = hashed gradient noise of the coordinate times `scale`, moved by n times `distortion`.
//   Octave k has the frequency lacunarity^k and the amplitude roughness^k; the fraction of
//   `octaves` weighs one octave more. Type 0: sum of the amplitudes times n, mapped to 0..1 if
//   `normalize`. 1: product of amplitude n + 1. 2: octaves weighted by those below. 3: squares of
//   offset - |n|. 4: steps relative to the height. 5: a random number of the coordinate times
//   `scale`, without octaves. With `color`, red, green and blue are three independent noises.
// Source:  Musgrave, in Ebert et al., "Texturing and Modeling", 1994, chapter 14; Blender's manual,
//          Noise and Musgrave Texture Nodes.
// Checked: tests/blender against Cycles; tests/effects
extern const ShaderSpec kOrielNoise;

namespace procedural {

/// Coordinates of the first 1 to 4 dimensions.
struct NoisePoint {
  float at[4];
  int dimensions;

  float noise() const { return sampling::hashed_noise({at, static_cast<std::size_t>(dimensions)}); }
  NoisePoint scaled(float factor) const;
  /// Moved to an independent part of the noise; each seed has its own.
  NoisePoint moved(float seed) const;
};

/// The coordinate times scale, and the time w as last dimension: 1 w; 2 xy; 3 xyz; 4 xyzw.
NoisePoint noise_point(const Vec3& coord, float w, int dimensions, float scale);

/// Sum of octaves divided by the sum of the amplitudes, in 0..1.
float fractal_sum(NoisePoint p, float octaves, float roughness, float lacunarity);

}  // namespace procedural
}  // namespace oriel
