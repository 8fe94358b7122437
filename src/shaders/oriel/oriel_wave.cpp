// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_wave.h"

#include <cmath>

#include "base/fraction.h"
#include "base/math.h"
#include "shaders/oriel/oriel_noise.h"

namespace oriel {
namespace {

struct WaveNode {
  Vec3 coord;
  float scale, distortion, octaves, noise_scale, roughness, phase;
  int shape, direction, profile;
};
struct MagicNode {
  Vec3 coord;
  float scale, distortion;
  int depth;
};

float position_of_wave(const WaveNode& n, const Vec3& p) {
  const int axis = std::clamp(n.direction, 0, 3);
  if (n.shape == 0) return axis == 3 ? 10 * (p.x + p.y + p.z) : 20 * p[axis];
  Vec3 from_axis = p;
  if (axis < 3) from_axis[axis] = 0;
  return 20 * length(from_axis);
}

void give_wave(const Call& call, void* result) {
  const auto& n = call.as<WaveNode>();
  // Whole coordinates of flat faces would have wave fronts within their rounding errors.
  const Vec3 p = (n.coord * n.scale + Vec3(1e-6f)) * 0.999999f;
  float x = position_of_wave(n, p) + n.phase;
  if (n.distortion != 0) {
    const procedural::NoisePoint at = procedural::noise_point(p, 0, 3, n.noise_scale);
    x += n.distortion * (2 * procedural::fractal_sum(at, n.octaves, n.roughness, 2) - 1);
  }
  const float turns = x / kTwoPi;
  float value = 0.5f + 0.5f * math::sin(x - kPi / 2);
  if (n.profile == 1) value = fraction(turns);
  if (n.profile == 2) value = 2 * std::abs(turns - std::floor(turns + 0.5f));
  *static_cast<Rgba*>(result) = Rgba(std::isfinite(value) ? value : 0);
}

void give_magic(const Call& call, void* result) {
  const auto& n = call.as<MagicNode>();
  const Vec3 p = n.coord * n.scale * 5.0f;
  float x = math::sin(p.x + p.y + p.z), y = math::cos(-p.x + p.y - p.z),
        z = -math::cos(-p.x - p.y + p.z);
  const float d = n.distortion;
  if (n.depth > 0) x *= d, y *= d, z *= d;
  if (n.depth > 0) y = -math::cos(x - y + z) * d;
  if (n.depth > 1) x = math::cos(x - y - z) * d;
  if (n.depth > 2) z = math::sin(-x - y - z) * d;
  if (n.depth > 3) x = -math::cos(-x + y - z) * d;
  if (n.depth > 4) y = -math::sin(-x + y + z) * d;
  if (n.depth > 5) y = -math::cos(-x + y + z) * d;
  if (n.depth > 6) x = math::cos(x + y + z) * d;
  if (n.depth > 7) z = math::sin(x + y - z) * d;
  if (n.depth > 8) x = -math::cos(-x - y + z) * d;
  if (n.depth > 9) y = -math::sin(x - y + z) * d;
  if (d != 0) x /= 2 * d, y /= 2 * d, z /= 2 * d;
  const auto channel = [](float c) { return std::isfinite(c) ? 0.5f - c : 0; };
  *static_cast<Rgba*>(result) = {channel(x), channel(y), channel(z), 1};
}

constexpr ParamSpec kWaveNodeRows[] = {
    {ORIEL_PARAM(WaveNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(WaveNode, scale), .fallback = {5}, .doc = "Factor of the coordinates."},
    {ORIEL_PARAM(WaveNode, distortion), .doc = "Movement of the waves by noise."},
    {ORIEL_PARAM(WaveNode, octaves), .fallback = {3}, .min = 0, .max = 16,
     .doc = "Number of octaves of the noise."},
    {ORIEL_PARAM(WaveNode, noise_scale), .fallback = {1}, .doc = "Frequency of the noise."},
    {ORIEL_PARAM(WaveNode, roughness), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Amplitude of an octave of the noise relative to the one before."},
    {ORIEL_PARAM(WaveNode, phase), .unit = "rad", .doc = "Position of the waves."},
    {ORIEL_PARAM(WaveNode, shape), .min = 0, .max = 1, .doc = "0 bands, 1 rings."},
    {ORIEL_PARAM(WaveNode, direction), .min = 0, .max = 3,
     .doc = "0 to 2 axis x, y or z; 3 diagonal bands, or spheres."},
    {ORIEL_PARAM(WaveNode, profile), .min = 0, .max = 2, .doc = "0 sine, 1 saw, 2 triangle."},
};
constexpr ParamSpec kMagicNodeRows[] = {
    {ORIEL_PARAM(MagicNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(MagicNode, scale), .fallback = {5}, .doc = "Factor of the coordinates."},
    {ORIEL_PARAM(MagicNode, distortion), .fallback = {1},
     .doc = "Factor of the sines that are arguments of others."},
    {ORIEL_PARAM(MagicNode, depth), .fallback = {2}, .min = 0, .max = 10,
     .doc = "Number of repetitions."},
};

}  // namespace

const ShaderSpec kOrielWave = {
    .name = "oriel_wave",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Bands or rings, distorted by noise.",
    .params = kWaveNodeRows,
    .params_size = sizeof(WaveNode),
    .value = give_wave,
};

const ShaderSpec kOrielMagic = {
    .name = "oriel_magic",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Coloured waves of waves.",
    .params = kMagicNodeRows,
    .params_size = sizeof(MagicNode),
    .value = give_magic,
};

}  // namespace oriel
