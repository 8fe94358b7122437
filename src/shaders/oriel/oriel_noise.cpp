// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_noise.h"

#include <algorithm>
#include <cmath>

#include "sampling/lattice_hash.h"

namespace oriel {
namespace {

using procedural::NoisePoint;

struct NoiseNode {
  Vec3 coord;
  float w, scale, octaves, roughness, lacunarity, distortion, offset, gain;
  int type, dimensions;
  bool normalize, color;
};

constexpr float kMostOctaves = 16;

/// Octaves of a sum: whole ones and the weight of one more.
struct Octaves {
  int whole;
  float rest;
};

Octaves octaves_of(float count) {
  if (!(count > 0)) return {0, 0};
  const float kept = std::min(count, kMostOctaves), low = std::floor(kept);
  return {static_cast<int>(low), kept - low};
}

float amplitude_sum(const NoiseNode& n, NoisePoint p) {
  const Octaves octaves = octaves_of(n.octaves);
  float sum = 0, amplitude = 1;
  for (int i = 0; i < octaves.whole; ++i) {
    sum += p.noise() * amplitude;
    amplitude *= n.roughness;
    p = p.scaled(n.lacunarity);
  }
  return octaves.rest > 0 ? sum + octaves.rest * p.noise() * amplitude : sum;
}

float multifractal(const NoiseNode& n, NoisePoint p) {
  const Octaves octaves = octaves_of(n.octaves);
  float value = 1, amplitude = 1;
  for (int i = 0; i < octaves.whole; ++i) {
    value *= amplitude * p.noise() + 1;
    amplitude *= n.roughness;
    p = p.scaled(n.lacunarity);
  }
  return octaves.rest > 0 ? value * (octaves.rest * amplitude * p.noise() + 1) : value;
}

float hybrid_multifractal(const NoiseNode& n, NoisePoint p) {
  const Octaves octaves = octaves_of(n.octaves);
  float value = 0, amplitude = 1, weight = 1;
  for (int i = 0; i < octaves.whole && weight > 1e-3f; ++i) {
    weight = std::min(weight, 1.0f);
    const float signal = (p.noise() + n.offset) * amplitude;
    value += weight * signal;
    weight *= n.gain * signal;
    amplitude *= n.roughness;
    p = p.scaled(n.lacunarity);
  }
  if (octaves.rest > 0 && weight > 1e-3f)
    value += octaves.rest * std::min(weight, 1.0f) * (p.noise() + n.offset) * amplitude;
  return value;
}

float ridged_multifractal(const NoiseNode& n, NoisePoint p) {
  const auto ridge = [&] { return sqr(n.offset - std::abs(p.noise())); };
  const Octaves octaves = octaves_of(n.octaves);
  float signal = ridge(), value = signal, amplitude = n.roughness;
  for (int i = 1; i < octaves.whole; ++i) {
    p = p.scaled(n.lacunarity);
    signal = ridge() * clamp01(signal * n.gain);
    value += signal * amplitude;
    amplitude *= n.roughness;
  }
  return value;
}

float hetero_terrain(const NoiseNode& n, NoisePoint p) {
  const Octaves octaves = octaves_of(n.octaves);
  float value = n.offset + p.noise(), amplitude = n.roughness;
  p = p.scaled(n.lacunarity);
  const auto step = [&] { return (p.noise() + n.offset) * amplitude * value; };
  for (int i = 1; i < octaves.whole; ++i) {
    value += step();
    amplitude *= n.roughness;
    p = p.scaled(n.lacunarity);
  }
  return octaves.rest > 0 ? value + octaves.rest * step() : value;
}

float noise_value(const NoiseNode& n, const NoisePoint& p) {
  switch (n.type) {
    case 1:
      return multifractal(n, p);
    case 2:
      return hybrid_multifractal(n, p);
    case 3:
      return ridged_multifractal(n, p);
    case 4:
      return hetero_terrain(n, p);
    default:
      return n.normalize ? procedural::fractal_sum(p, n.octaves, n.roughness, n.lacunarity)
                         : amplitude_sum(n, p);
  }
}

float finite_noise(float x) { return std::isfinite(x) ? x : 0; }

constexpr int kWhiteNoise = 5;

void give_noise(const Call& call, void* result) {
  const auto& n = call.as<NoiseNode>();
  NoisePoint p = procedural::noise_point(n.coord, n.w, n.dimensions, n.scale);
  if (n.type == kWhiteNoise) {
    const auto c = sampling::position_color({p.at, static_cast<std::size_t>(p.dimensions)});
    *static_cast<Rgba*>(result) = n.color ? Rgba{c[0], c[1], c[2], 1} : Rgba{c[0], c[0], c[0], 1};
    return;
  }
  if (n.distortion != 0) {
    const NoisePoint before = p;
    for (int i = 0; i < p.dimensions; ++i)
      p.at[i] += before.moved(static_cast<float>(i)).noise() * n.distortion;
  }
  Rgba& out = *static_cast<Rgba*>(result);
  out = Rgba(finite_noise(noise_value(n, p)));
  out.a = 1;
  if (!n.color) return;
  const auto next = static_cast<float>(p.dimensions);
  out.g = finite_noise(noise_value(n, p.moved(next)));
  out.b = finite_noise(noise_value(n, p.moved(next + 1)));
}

constexpr ParamSpec kNoiseRows[] = {
    {ORIEL_PARAM(NoiseNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(NoiseNode, w), .doc = "Coordinate of dimension 4, or of dimension 1 alone."},
    {ORIEL_PARAM(NoiseNode, scale), .fallback = {5}, .doc = "Factor of the coordinates."},
    {ORIEL_PARAM(NoiseNode, octaves), .fallback = {3}, .min = 0, .max = kMostOctaves,
     .doc = "Number of octaves."},
    {ORIEL_PARAM(NoiseNode, roughness), .fallback = {.5f}, .min = 0,
     .doc = "Amplitude of an octave relative to the one before."},
    {ORIEL_PARAM(NoiseNode, lacunarity), .fallback = {2}, .min = 0,
     .doc = "Frequency of an octave relative to the one before."},
    {ORIEL_PARAM(NoiseNode, distortion), .doc = "Movement of the coordinates by noise."},
    {ORIEL_PARAM(NoiseNode, offset), .doc = "Level of types 2 to 4."},
    {ORIEL_PARAM(NoiseNode, gain), .fallback = {1}, .doc = "Gain of types 2 and 3."},
    {ORIEL_PARAM(NoiseNode, type), .min = 0, .max = kWhiteNoise,
     .doc = "0 sum, 1 multifractal, 2 hybrid multifractal, 3 ridged multifractal, 4 hetero "
            "terrain, 5 white noise: a random number of each place."},
    {ORIEL_PARAM(NoiseNode, dimensions), .fallback = {3}, .min = 1, .max = 4,
     .doc = "1 w, 2 x and y, 3 x, y and z, 4 all."},
    {ORIEL_PARAM(NoiseNode, normalize), .fallback = {1},
     .doc = "Whether the result of type 0 is mapped to 0..1."},
    {ORIEL_PARAM(NoiseNode, color), .doc = "Whether the channels are independent noises."},
};

}  // namespace

namespace procedural {

NoisePoint NoisePoint::scaled(float factor) const {
  NoisePoint p = *this;
  for (float& x : p.at) x *= factor;
  return p;
}

NoisePoint NoisePoint::moved(float seed) const {
  NoisePoint p = *this;
  for (int i = 0; i < dimensions; ++i) {
    const float key[] = {seed, static_cast<float>(i)};
    p.at[i] += 100 + 100 * sampling::position_hash({key, dimensions == 1 ? 1u : 2u});
  }
  return p;
}

NoisePoint noise_point(const Vec3& coord, float w, int dimensions, float scale) {
  const int n = std::clamp(dimensions, 1, 4);
  NoisePoint p{{coord.x, coord.y, coord.z, w}, n};
  if (n == 1) p.at[0] = w;
  return p.scaled(scale);
}

float fractal_sum(NoisePoint p, float octaves, float roughness, float lacunarity) {
  const Octaves count = octaves_of(octaves);
  float sum = 0, amplitude = 1, most = 0;
  for (int i = 0; i < std::max(count.whole, 1); ++i) {
    sum += (0.5f * p.noise() + 0.5f) * amplitude;
    most += amplitude;
    amplitude *= clamp01(roughness);
    p = p.scaled(lacunarity);
  }
  if (!(count.rest > 0) || count.whole == 0) return sum / most;
  const float more = sum + (0.5f * p.noise() + 0.5f) * amplitude;
  return (1 - count.rest) * sum / most + count.rest * more / (most + amplitude);
}

}  // namespace procedural

const ShaderSpec kOrielNoise = {
    .name = "oriel_noise",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Sum of octaves of gradient noise, and multifractals.",
    .params = kNoiseRows,
    .params_size = sizeof(NoiseNode),
    .value = give_noise,
};

}  // namespace oriel
