// SPDX-License-Identifier: Apache-2.0
// Mappings of uniform random numbers to points and directions with their densities, and MIS
// weights.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::sampling {

// Conventions
//   u is uniform in [0,1)^2. Directions are unit, around +z. `pdf` is per solid angle.

struct SinCos {
  float sin, cos;
};
/// Sine and cosine of |x| <= pi / 4 rad within 1e-7 (Taylor series; library functions take several
/// times as long as the rest of a mapping).
/// Checked: Warp.SineAndCosineMatchTheLibrary.
inline SinCos sincos_octant(float x) {
  const float x2 = x * x;
  const float s =
      fma(x2, fma(x2, fma(x2, fma(x2, 1 / 362880.0f, -1 / 5040.0f), 1 / 120.0f), -1 / 6.0f), 1);
  const float c =
      fma(x2, fma(x2, fma(x2, fma(x2, 1 / 40320.0f, -1 / 720.0f), 1 / 24.0f), -0.5f), 1);
  return {x * s, c};
}
/// Sine and cosine of u turns, u in [0, 1].
inline SinCos sincos_turns(float u) {
  // Never negative, so truncation rounds. NOLINTNEXTLINE(bugprone-incorrect-roundings)
  const int quarter = static_cast<int>(4 * u + 0.5f);
  const SinCos t = sincos_octant((4 * u - static_cast<float>(quarter)) * (kPi / 2));
  const float s = quarter & 1 ? t.cos : t.sin, c = quarter & 1 ? t.sin : t.cos;
  return {quarter & 2 ? -s : s, (quarter + 1) & 2 ? -c : c};
}

/// Point on the unit disc, uniform in area; the mapping is continuous.
/// Source:  Shirley, Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
/// Checked: Warp.DiscMatchesItsDensity.
inline Vec2 sample_disc(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return Vec2(0, 0);
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b;
  const SinCos t = sincos_octant((kPi / 4) * (wide ? b / a : a / b));
  return wide ? Vec2(r * t.cos, r * t.sin) : Vec2(r * t.sin, r * t.cos);
}

/// The point of the square that sample_disc() maps to `d`.
/// Source:  the arc tangent of Abramowitz, Stegun, "Handbook of Mathematical Functions", 4.4.49,
///          within 2e-8.
/// Checked: Warp.SquareOfDiscInvertsTheDisc.
inline Vec2 square_of_disc(const Vec2& d) {
  const bool wide = std::abs(d.x) > std::abs(d.y);
  const float major = wide ? d.x : d.y, minor = wide ? d.y : d.x;
  if (major == 0) return Vec2(0.5f, 0.5f);
  const float r = std::copysign(std::min(1.0f, std::sqrt(d.x * d.x + d.y * d.y)), major);
  const float x = minor / major, x2 = x * x;
  float sum = 0.0028662257f;
  for (const float term : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f,
                           -0.1420889944f, 0.1999355085f, -0.3333314528f, 1.0f})
    sum = fma(sum, x2, term);
  const float other = r * (x * sum) * (4 / kPi);
  return Vec2(0.5f + 0.5f * (wide ? r : other), 0.5f + 0.5f * (wide ? other : r));
}

/// Direction on the upper hemisphere with density cos / pi.
/// Checked: Warp.DirectionsMatchTheirDensity.
inline Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = sample_disc(u);
  // A tiny positive z keeps the density positive for samples on the rim.
  return Vec3(d.x, d.y, std::sqrt(std::max(1e-12f, 1 - d.x * d.x - d.y * d.y)));
}
inline float cosine_hemisphere_pdf(float cos_theta) { return std::max(0.0f, cos_theta) * kInvPi; }

/// Direction in the cap of the hemisphere with cosine at least `least`; the density is proportional
/// to the cosine.
/// Checked: Warp.CapDirectionsMatchTheirDensity.
inline Vec3 sample_cosine_cap(const Vec2& u, float least) {
  const float sine2 = u.x * (1 - least * least), phi = kTwoPi * u.y;
  const float sine = std::sqrt(sine2);
  return Vec3(sine * math::cos(phi), sine * math::sin(phi), std::sqrt(std::max(0.0f, 1 - sine2)));
}

inline constexpr float kUniformSpherePdf = 0.25f * kInvPi;

/// Uniform direction on the sphere.
inline Vec3 sample_uniform_sphere(const Vec2& u) {
  const float z = 1 - 2 * u.x;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  const SinCos phi = sincos_turns(u.y);
  return Vec3(r * phi.cos, r * phi.sin, z);
}

/// 1 - cos(theta) from sin^2(theta) for theta up to 90 degrees, without cancellation for narrow
/// cones.
inline float one_minus_cos(float sin2_theta) {
  return sin2_theta / (1 + std::sqrt(std::max(0.0f, 1 - sin2_theta)));
}

/// Uniform direction in the cone around +z. The width is given as 1 - cos(half angle), because a
/// float cosine cannot represent the size of the sun. The distance from the axis increases with
/// u.x.
inline Vec3 sample_cone(const Vec2& u, float one_minus_cos_max) {
  const float h = u.x * one_minus_cos_max;
  const float r = std::sqrt(std::max(0.0f, h * (2 - h)));
  const SinCos phi = sincos_turns(u.y);
  return Vec3(r * phi.cos, r * phi.sin, 1 - h);
}
inline float cone_pdf(float one_minus_cos_max) { return 1 / (kTwoPi * one_minus_cos_max); }

/// Barycentric weights of the second and third corner of a triangle, uniform in area (the density
/// is 1 / area).
/// Source: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
inline Vec2 sample_triangle(const Vec2& u) {
  if (u.y > u.x) {
    const float x = u.x * 0.5f;
    return Vec2(x, u.y - x);
  }
  const float y = u.y * 0.5f;
  return Vec2(u.x - y, y);
}

/// MIS weight of the first of two sampling techniques, from their densities times sample counts; 0
/// if its density is 0, 1 if its density is infinite (delta).
/// Source:  Veach, Guibas, "Optimally Combining Sampling Techniques", SIGGRAPH 1995.
/// Checked: Heuristics.SharesSumToOne.
inline float balance_heuristic(float pdf_this, float pdf_other) {
  return pdf_this > 0 ? 1 / (1 + pdf_other / pdf_this) : 0;
}
/// Same with squared densities.
inline float power_heuristic(float pdf_this, float pdf_other) {
  return pdf_this > 0 ? 1 / (1 + sqr(pdf_other / pdf_this)) : 0;
}

}  // namespace oriel::sampling
