// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_texture_procedural.h"

#include <algorithm>
#include <cmath>

#include "base/fraction.h"
#include "base/math.h"
#include "sampling/gradient_noise.h"

namespace oriel {
namespace {

struct Checkerboard {
  Vec3 coord;
  float xsize, ysize, zsize;
  Rgba color000, color001, color010, color011, color100, color101, color110, color111;
};
struct Dots {
  Vec3 coord;
  float radius;
  Rgba fgcolor, bgcolor;
};
struct Turbulence {
  Vec3 coord;
  float spacing, strength, power;
  int iteration, polar_dim;
};
struct Wave {
  Vec3 coord;
  float amplitude_x, amplitude_y, amplitude_z, offset;
};

constexpr const char* kCoord = "Texture coordinate.";
constexpr const char* kBox = "Box colour; digits are x, y, z; 0 = the low side.";

constexpr ParamSpec kCheckerboardRows[] = {
    {ORIEL_PARAM(Checkerboard, coord), .doc = kCoord, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, xsize), .doc = "Fraction of the low side in x.",
     .declared_default = false},
    {ORIEL_PARAM(Checkerboard, ysize), .doc = "Fraction of the low side in y.",
     .declared_default = false},
    {ORIEL_PARAM(Checkerboard, zsize), .doc = "Fraction of the low side in z.",
     .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color000), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color001), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color010), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color011), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color100), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color101), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color110), .doc = kBox, .declared_default = false},
    {ORIEL_PARAM(Checkerboard, color111), .doc = kBox, .declared_default = false},
};
constexpr ParamSpec kDotsRows[] = {
    {ORIEL_PARAM(Dots, coord), .doc = kCoord, .declared_default = false},
    {ORIEL_PARAM(Dots, radius), .doc = "Dot radius; cells have width 1.",
     .declared_default = false},
    {ORIEL_PARAM(Dots, fgcolor), .doc = "Dot colour.", .declared_default = false},
    {ORIEL_PARAM(Dots, bgcolor), .doc = "Background colour.", .declared_default = false},
};
constexpr ParamSpec kTurbulenceRows[] = {
    {ORIEL_PARAM(Turbulence, coord), .doc = kCoord, .declared_default = false},
    {ORIEL_PARAM(Turbulence, spacing), .doc = "Noise frequency in the unit cube; 0 = 1.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Turbulence, strength), .doc = "Noise weight; 0 = 1.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Turbulence, power), .doc = "Amplitude decay per octave; 0 = 1.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Turbulence, iteration), .max = 8, .doc = "Number of octaves; 0 = 2.",
     .declared_default = false},
    {ORIEL_PARAM(Turbulence, polar_dim), .doc = "Noise shape: 0 isotropic, 1 lines, 2 cylinders.",
     .support = Support::Approximated, .declared_default = false},
};
constexpr ParamSpec kWaveRows[] = {
    {ORIEL_PARAM(Wave, coord), .doc = kCoord, .declared_default = false},
    {ORIEL_PARAM(Wave, amplitude_x), .doc = "Amplitude along x.", .declared_default = false},
    {ORIEL_PARAM(Wave, amplitude_y), .doc = "Amplitude along y.", .declared_default = false},
    {ORIEL_PARAM(Wave, amplitude_z), .doc = "Amplitude along z.", .declared_default = false},
    {ORIEL_PARAM(Wave, offset), .doc = "Offset of the waves.", .declared_default = false},
};

Vec3 in_cell(const Vec3& p) { return Vec3(fraction(p.x), fraction(p.y), fraction(p.z)); }

void checkerboard(const Call& call, void* result) {
  const auto& p = call.as<Checkerboard>();
  static constexpr Rgba Checkerboard::*kBoxes[] = {
      &Checkerboard::color000, &Checkerboard::color001, &Checkerboard::color010,
      &Checkerboard::color011, &Checkerboard::color100, &Checkerboard::color101,
      &Checkerboard::color110, &Checkerboard::color111};
  const Vec3 c = in_cell(p.coord);
  const int box = (c.x < p.xsize ? 0 : 4) + (c.y < p.ysize ? 0 : 2) + (c.z < p.zsize ? 0 : 1);
  *static_cast<Rgba*>(result) = p.*kBoxes[box];
}

void polkadot(const Call& call, void* result) {
  const auto& p = call.as<Dots>();
  const Vec3 c = in_cell(p.coord) - Vec3(0.5f);
  *static_cast<Rgba*>(result) = sqr(c.x) + sqr(c.y) < sqr(p.radius) ? p.fgcolor : p.bgcolor;
}

void polkasphere(const Call& call, void* result) {
  const auto& p = call.as<Dots>();
  const Vec3 c = in_cell(p.coord) - Vec3(0.5f);
  *static_cast<Rgba*>(result) = dot(c, c) < sqr(p.radius) ? p.fgcolor : p.bgcolor;
}

float or_one(float x) { return x != 0 ? x : 1; }

void turbulence(const Call& call, void* result) {
  const auto& p = call.as<Turbulence>();
  Vec3 at = p.coord;
  if (p.polar_dim == 1) at.y = 0;
  if (p.polar_dim >= 2) at = Vec3(math::hypot(at.x - 0.5f, at.y - 0.5f), 0, 0);
  at *= or_one(p.spacing);
  const int passes = p.iteration == 0 ? 2 : std::clamp(p.iteration, 1, 8);
  const float weaker = math::exp2(-or_one(p.power));
  float sum = 0, weight = 1;
  for (int k = 0; k < passes; ++k, at *= 2.0f, weight *= weaker)
    sum += weight * std::abs(sampling::gradient_noise(at));
  *static_cast<float*>(result) = sum * or_one(p.strength);
}

void wave(const Call& call, void* result) {
  const auto& p = call.as<Wave>();
  // Remove whole turns first, to keep precision for distant coordinates.
  const Vec3 c = in_cell(p.coord) * kTwoPi;
  *static_cast<Rgba*>(result) =
      Rgba(p.offset + p.amplitude_x * math::cos(c.x) + p.amplitude_y * math::cos(c.y) +
           p.amplitude_z * math::cos(c.z));
}

}  // namespace

const ShaderSpec kMibTextureCheckerboard = {
    .name = "mib_texture_checkerboard",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Eight boxes in the unit cube, for stripes and checkerboards.",
    .params = kCheckerboardRows,
    .params_size = sizeof(Checkerboard),
    .value = checkerboard,
};

const ShaderSpec kMibTexturePolkadot = {
    .name = "mib_texture_polkadot",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Round dot in each unit square.",
    .params = kDotsRows,
    .params_size = sizeof(Dots),
    .value = polkadot,
};

const ShaderSpec kMibTexturePolkasphere = {
    .name = "mib_texture_polkasphere",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Sphere in each unit cube.",
    .params = kDotsRows,
    .params_size = sizeof(Dots),
    .value = polkasphere,
};

const ShaderSpec kMibTextureTurbulence = {
    .name = "mib_texture_turbulence",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Turbulence: noise of several octaves.",
    .params = kTurbulenceRows,
    .params_size = sizeof(Turbulence),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value = turbulence,
};

const ShaderSpec kMibTextureWave = {
    .name = "mib_texture_wave",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Sum of cosine waves along the three axes, as grey.",
    .params = kWaveRows,
    .params_size = sizeof(Wave),
    .value = wave,
};

}  // namespace oriel
