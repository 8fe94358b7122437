// SPDX-License-Identifier: Apache-2.0
// The clear-sky model of Preetham, Shirley and Smits: fits and Perez evaluation.
#include "sky/preetham.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "base/math.h"
#include "color/black_body.h"
#include "color/luminance.h"

namespace oriel::sky {
namespace {

/// XYZ to linear sRGB with the three decimals of NVIDIA's port, so that results match.
Rgb sky_rgb(const Vec3& xyz) {
  return Rgb(std::max(3.241f * xyz.x - 1.537f * xyz.y - 0.499f * xyz.z, 0.0f),
             std::max(-0.969f * xyz.x + 1.876f * xyz.y + 0.042f * xyz.z, 0.0f),
             std::max(0.056f * xyz.x - 0.204f * xyz.y + 1.057f * xyz.z, 0.0f));
}

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3
float cubic(const float (&c)[4], float t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

/// e^x with a relative error of 2e-7 for -80 < x < 80, clamped beyond. Branch-free, so that the
/// compiler vectorises it; with the library function a lookup takes 1.7 times as long.
inline float lane_exp(float x) {
  constexpr float kLog2E = 1.44269504089f, kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f;
  constexpr float kRounder = 12582912.0f;  // 1.5 * 2^23: adding it rounds to an integer
  x = clamp(x, -80, 80);
  const float shifted = x * kLog2E + kRounder;
  const float n = shifted - kRounder;
  const float r = (x - n * kLn2High) - n * kLn2Low;
  // Taylor to the sixth order: |r| <= ln(2) / 2, remainder below 1.3e-7.
  const float p =
      1 + r * (1 + r * (1.0f / 2 + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r / 720)))));
  const auto exponent =
      std::bit_cast<std::int32_t>(shifted) - std::bit_cast<std::int32_t>(kRounder);
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(p) + (exponent << 23));
}

/// Minimum that keeps the division below finite; real chromaticities are far above it.
constexpr float kMinChromaticity = 0.01f;

}  // namespace

Vec3 lifted_above_horizon(const Vec3& direction) {
  if (direction.z >= kLowestSkyZ) return direction;
  return normalize(Vec3(direction.x, direction.y, kLowestSkyZ));
}

float zenith_luminance(float turbidity, float sun_zenith_angle) {
  const float chi = (4.0f / 9.0f - turbidity / 120) * (kPi - 2 * sun_zenith_angle);
  const float kcd =
      (4.0453f * turbidity - 4.9710f) * math::tan(chi) - 0.2155f * turbidity + 2.4192f;
  return std::max(1000 * kcd, 0.0f);
}

Vec2 zenith_chromaticity(float turbidity, float sun_zenith_angle) {
  // Rows: T^2, T, 1; columns: powers of the zenith angle of the sun.
  constexpr float kX[3][4] = {{0, 0.002088f, -0.003742f, 0.001650f},
                              {0.003948f, -0.032020f, 0.063773f, -0.029028f},
                              {0.258852f, 0.060523f, -0.211960f, 0.116936f}};
  constexpr float kY[3][4] = {{0, 0.003162f, -0.006105f, 0.002759f},
                              {0.005158f, -0.041536f, 0.089701f, -0.042149f},
                              {0.266881f, 0.066698f, -0.267568f, 0.153467f}};
  const auto value = [&](const float(&k)[3][4]) {
    return (cubic(k[0], sun_zenith_angle) * turbidity + cubic(k[1], sun_zenith_angle)) * turbidity +
           cubic(k[2], sun_zenith_angle);
  };
  return Vec2(value(kX), value(kY));
}

Rgb sun_illuminance_outside_atmosphere(bool black_body) {
  constexpr float kSolarIlluminanceLux = 127500;  // IES, Recommended Practice, 1984
  if (black_body) {
    constexpr float kSunKelvin = 5900;
    static const Rgb colour = black_body_color(kSunKelvin);
    return colour * (kSolarIlluminanceLux / luminance(colour));
  }
  // The colour used by mental ray; 0.9878 is its Rec. 709 luminance.
  return Rgb(1, 0.992f, 0.911f) * (kSolarIlluminanceLux / 0.9878f);
}

Rgb sun_illuminance(float sun_z, float turbidity, bool black_body) {
  if (!(sun_z > 0)) return Rgb(0.0f);

  // Relative optical air mass, Kasten 1966.
  const float zenith_deg = math::acos(std::min(sun_z, 1.0f)) * (180 / kPi);
  const float mass = 1 / (sun_z + 0.15f * math::pow(93.885f - zenith_deg, -1.253f));

  // Optical depth of Rayleigh scattering, aerosol (Angstrom) and ozone at each wavelength.
  constexpr float kWavelengthUm[3] = {0.610f, 0.550f, 0.470f};
  constexpr float kOzonePerCm[3] = {12.0f, 8.5f, 0.9f};
  constexpr float kOzone = 0.0035f;
  const float beta = 0.04608f * turbidity - 0.04586f;
  Rgb sun = sun_illuminance_outside_atmosphere(black_body);
  for (int i = 0; i < 3; ++i) {
    const float rayleigh = 0.008735f * math::pow(kWavelengthUm[i], -4.08f);
    const float aerosol = beta * math::pow(kWavelengthUm[i], -1.3f);
    sun[i] *= math::exp(-mass * (rayleigh + aerosol + kOzonePerCm[i] * kOzone));
  }
  return sun;
}

PreethamSky::PreethamSky(const Vec3& to_sun, float turbidity, const PreethamOptions& options)
    : to_sun_(lifted_above_horizon(to_sun)), clamp_antisolar_(options.clamp_antisolar) {
  const float t = clamp(turbidity, 2.0f, kMaxTurbidity);
  const float zenith_angle = math::acos(std::min(to_sun_.z, 1.0f));

  // The paper has the constant -0.259188 in A of x. The port's value depends on the sun's elevation
  // and equals the paper's near a zenith angle of 83 degrees.
  const float ax = options.paper_chromaticity ? 0.259188f : 0.29f - 0.09f * std::sqrt(to_sun_.z);
  perez_ = {{0.178721f * t - 1.463037f, -0.019257f * t - ax, -0.016698f * t - 0.260787f, 0},
            {-0.355402f * t + 0.427494f, -0.066513f * t + 0.000818f, -0.094958f * t + 0.009213f, 0},
            {-0.022669f * t + 5.325056f, -0.000417f * t + 0.212479f, -0.007928f * t + 0.210230f, 0},
            {0.120647f * t - 2.577052f, -0.064097f * t - 0.898875f, -0.044050f * t - 1.653694f, 0},
            {-0.066967f * t + 0.370275f, -0.003251f * t + 0.045178f, -0.010922f * t + 0.052919f, 0},
            {1, 1, 1, 1}};

  // Divide by the zenith value: at the zenith theta is 0 and gamma is the zenith angle of the sun.
  const Vec2 chromaticity = zenith_chromaticity(t, zenith_angle);
  const float zenith[kLanes] = {zenith_luminance(t, zenith_angle), chromaticity.x, chromaticity.y,
                                0};
  float at_zenith[kLanes];
  evaluate(1, std::min(to_sun_.z, 1.0f), at_zenith);
  for (int i = 0; i < kLanes; ++i) perez_.scale[i] = zenith[i] / at_zenith[i];
}

void PreethamSky::distribute(const PerezCoefficients& k) {
  float before[kLanes], after[kLanes];
  evaluate(1, std::min(to_sun_.z, 1.0f), before);
  // Far beyond any real sky; only keeps products finite.
  constexpr float kMax = 1000, kMaxGrowth = 5, kMinZenith = 1e-4f;
  perez_.a[0] = clamp(k.a, -kMax, kMax), perez_.b[0] = clamp(k.b, -kMax, 0);
  perez_.c[0] = clamp(k.c, -kMax, kMax), perez_.d[0] = clamp(k.d, -kMax, kMaxGrowth);
  perez_.e[0] = clamp(k.e, -kMax, kMax), perez_.scale[0] = 1;
  evaluate(1, std::min(to_sun_.z, 1.0f), after);
  if (after[0] > kMinZenith) perez_.scale[0] = before[0] / after[0];
}

void PreethamSky::evaluate(float cos_theta, float cos_gamma, float (&value)[kLanes]) const {
  const float inverse_cos = 1 / cos_theta;
  const float gamma = math::acos(cos_gamma);
  float gammas[kLanes] = {gamma, gamma, gamma, gamma};
  float cosines[kLanes] = {cos_gamma, cos_gamma, cos_gamma, cos_gamma};
  if (clamp_antisolar_ && cos_gamma < 0) {
    gammas[0] = kPi / 2;
    cosines[0] = 0;
  }
  const Perez& p = perez_;
  for (int i = 0; i < kLanes; ++i) {
    const float gradient = 1 + p.a[i] * lane_exp(p.b[i] * inverse_cos);
    const float indicatrix =
        1 + p.c[i] * lane_exp(p.d[i] * gammas[i]) + p.e[i] * cosines[i] * cosines[i];
    value[i] = p.scale[i] * gradient * indicatrix;
  }
}

PreethamSky::Xyy PreethamSky::xyy(const Vec3& direction) const {
  const Vec3 w = lifted_above_horizon(direction);
  float value[kLanes];
  evaluate(w.z, clamp(dot(w, to_sun_), -1, 1), value);
  return {value[1], value[2], std::max(value[0], 0.0f)};
}

Rgb PreethamSky::radiance(const Vec3& direction) const {
  const Xyy c = xyy(direction);
  const float per_y = c.luminance / std::max(c.y, kMinChromaticity);
  return sky_rgb(Vec3(c.x * per_y, c.luminance, (1 - c.x - c.y) * per_y));
}

}  // namespace oriel::sky
