// SPDX-License-Identifier: Apache-2.0
#include "sky/cie_sky.h"

#include <algorithm>

#include "base/math.h"
#include "sky/physical_sky.h"
#include "sky/units.h"

namespace oriel::sky {
namespace {

/// Relative luminance as a function of the angle to the sun.
float indicatrix(float cos_gamma) {
  const float gamma = math::acos(clamp(cos_gamma, -1, 1));
  return 0.91f + 10 * math::exp(-3 * gamma) + 0.45f * sqr(cos_gamma);
}

/// Relative luminance from the zenith to the horizon; the exponential is 0 on the horizon.
float gradation(float cos_theta) {
  return cos_theta > 0 ? 1 - math::exp(-0.32f / cos_theta) : 1.0f;
}

}  // namespace

float cie_clear_relative(float cos_theta, float cos_gamma, float sun_z) {
  return indicatrix(cos_gamma) * gradation(cos_theta) / (indicatrix(sun_z) * gradation(1));
}

float cie_clear_horizontal(float sun_z) {
  // Midpoint rule with equal steps in sin^2 of the zenith angle (cosine-weighted) and azimuth.
  constexpr int kRings = 64, kSectors = 96;
  const float sun_x = std::sqrt(std::max(0.0f, 1 - sqr(sun_z)));
  double sum = 0;  // double: sums thousands of similar terms
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;
    const float r = std::sqrt(sin2), z = std::sqrt(1 - sin2);
    for (int j = 0; j < kSectors; ++j) {
      const float phi = kTwoPi * (static_cast<float>(j) + 0.5f) / kSectors;
      sum += cie_clear_relative(z, r * math::cos(phi) * sun_x + z * sun_z, sun_z);
    }
  }
  return static_cast<float>(sum * kPi / (kRings * kSectors));
}

float cie_clear_zenith(float sun_z) {
  constexpr float kTurbidity = 2.45f, kHighest = 0.99862953f;  // sine of 87 degrees
  const float s = clamp(sun_z, 0, kHighest);
  const float tangent = s / std::sqrt(1 - sqr(s));
  return 1000 * ((1.376f * kTurbidity - 1.81f) * tangent + 0.38f) * night_factor(sun_z);
}

float cie_overcast_zenith(float sun_z) {
  return 1000 * (8.6f * clamp01(sun_z) + 0.123f) * night_factor(sun_z);
}

CieSky::CieSky(const CieParameters& p)
    : y_is_up_(p.y_is_up), scale_(unit_conversion(p.rgb_unit_conversion) * kPi) {
  if (!p.on) return;
  to_sun_ = z_up(normalize(p.sun_direction), p.y_is_up);
  const float overcast = clamp01(p.overcast), sun_z = to_sun_.z;
  // A sun below the horizon is moved to the horizon.
  to_sun_ = normalize(Vec3(to_sun_.x, to_sun_.y, std::max(to_sun_.z, 0.0f)));
  clear_ = 1 - overcast;
  overcast_ = overcast;
  if (p.zenith_luminance > 0) {
    clear_ *= p.zenith_luminance;
    overcast_ *= p.zenith_luminance;
  } else if (p.diffuse_horizontal_illuminance > 0) {
    const float horizontal =
        clear_ * cie_clear_horizontal(to_sun_.z) + overcast_ * kCieOvercastHorizontal;
    clear_ *= p.diffuse_horizontal_illuminance / horizontal;
    overcast_ *= p.diffuse_horizontal_illuminance / horizontal;
  } else if (p.auto_luminance) {
    clear_ *= cie_clear_zenith(sun_z);
    overcast_ *= cie_overcast_zenith(sun_z);
  } else {
    clear_ = overcast_ = 0;
  }
}

float CieSky::luminance(const Vec3& direction) const {
  const Vec3 d = z_up(direction, y_is_up_);
  if (d.z <= 0) return 0;
  float value = overcast_ * cie_overcast_relative(d.z);
  if (clear_ > 0) value += clear_ * cie_clear_relative(d.z, dot(d, to_sun_), to_sun_.z);
  return value;
}

}  // namespace oriel::sky
