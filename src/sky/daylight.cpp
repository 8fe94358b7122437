// SPDX-License-Identifier: Apache-2.0
// Components of the physical sky: illuminance integrals, disc and glow of the sun, aerial
// perspective.
#include "sky/daylight.h"

#include "base/math.h"
#include "sky/physical_sky.h"

#include <algorithm>

namespace oriel::sky {
namespace {

/// Area-preserving map of the square -1..1 to the unit disc.
/// Source: Shirley, Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
Vec2 concentric_disc(float x, float y) {
  if (x == 0 && y == 0) return Vec2(0, 0);
  const bool wide = std::fabs(x) > std::fabs(y);
  const float r = wide ? x : y;
  const float phi = wide ? kPi / 4 * (y / x) : kPi / 2 - kPi / 4 * (x / y);
  return Vec2(r * math::cos(phi), r * math::sin(phi));
}

/// Integral of the glow profile over the sphere for a glow of angular radius g: 2 (1 - a/g)^3 times
/// 2 pi sin a da. In double, because the closed form has cancellation of order g^-4.
double glow_integral(double g) {
  constexpr double kPi64 = 3.14159265358979323846;
  const double g2 = g * g;
  if (g < 0.5) return 24 * kPi64 * g2 * (1.0 / 120 - g2 * (1.0 / 5040 - g2 / 362880));
  return 4 * kPi64 - 24 * kPi64 / g2 + 24 * kPi64 * math::sin(g) / (g2 * g);
}

}  // namespace

Rgb horizontal_illuminance(const PreethamSky& sky) {
  // Midpoint rule with equal steps in sin^2 of the zenith angle (cosine-weighted) and azimuth.
  constexpr int kRings = 48, kSectors = 96;
  double sum[3] = {0, 0, 0};  // double: sums thousands of similar terms
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;
    const float r = std::sqrt(sin2), z = std::sqrt(1 - sin2);
    for (int j = 0; j < kSectors; ++j) {
      const float phi = kTwoPi * (static_cast<float>(j) + 0.5f) / kSectors;
      const Rgb c = sky.radiance(Vec3(r * math::cos(phi), r * math::sin(phi), z));
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
  }
  const double scale = static_cast<double>(kPi) / (kRings * kSectors);
  return Rgb(static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale),
             static_cast<float>(sum[2] * scale));
}

Rgb horizontal_illuminance_25(const PreethamSky& sky) {
  Rgb sum(0.0f);
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      const Vec2 p = concentric_disc(0.4f * static_cast<float>(i), 0.4f * static_cast<float>(j));
      const float z = std::sqrt(std::max(1 - p.x * p.x - p.y * p.y, 0.0f));
      sum += sky.radiance(Vec3(p.x, p.y, z));
    }
  }
  return sum * (kPi / 25);
}

DiscScale physical_disc_scale(float disc_scale, float disc_intensity, float glow_intensity) {
  if (!(disc_intensity > 0) || !(disc_scale > 0)) return {};
  const float radius = kSunAngularRadius * disc_scale;
  const float target = kPi * disc_intensity;
  const float glow = std::max(glow_intensity, 0.0f) *
                     static_cast<float>(glow_integral(10.0 * static_cast<double>(radius)));
  const float kept = std::min(glow, 0.5f * target);
  // Half-angle form of the cap area: 1 - cos has no significant digits at this size.
  const float cap = 4 * kPi * sqr(math::sin(0.5f * std::min(radius, kPi)));
  DiscScale scale;
  scale.glow = glow > 0 ? kept / glow : 1;
  scale.disc = (target - kept) / (cap * 100 * disc_intensity);
  return scale;
}

float sun_cone_angle(float shadow_softness, float haze) {
  constexpr float kSpreadPerHaze = 0.1f;
  return kSunAngularRadius * std::max(0.0f, shadow_softness) *
         (1 + kSpreadPerHaze * std::max(0.0f, haze));
}

float aerial_haze(float distance, float visibility_distance, float haze) {
  if (!(visibility_distance > 0) || !(distance > 0)) return 0;
  constexpr float kTenPercent = 0.1053605f;  // -ln 0.9
  const float depth = kTenPercent * (1 + std::max(haze, 0.0f)) * distance / visibility_distance;
  return -math::expm1(-depth);
}

}  // namespace oriel::sky
