// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth boundaries: dielectric, user-defined curve, pane, and their means.
#pragma once

#include <cmath>
#include <optional>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::bsdf {

// Conventions
//   cos_o >= 0 is the cosine between the viewer's direction and the normal on its side.
//   eta is the index of the far side divided by the index of the viewer's side.

/// Direction of the ray refracted at a boundary with normal h; unset on total internal reflection.
///
/// Inputs:  w: unit, away from the boundary, dot(w, h) > 0. eta as above.
/// Returns: unit, away from the boundary, on the far side.
/// Checked: Refraction.FollowsSnell, Refraction.TotalReflectionBeginsAtTheCriticalAngle.
inline std::optional<Vec3> refract(const Vec3& w, const Vec3& h, float eta) {
  const float c = dot(w, h);
  const float inv = 1 / eta;
  const float cos2 = 1 - (1 - c * c) * inv * inv;
  if (cos2 <= 0) return std::nullopt;
  return h * (c * inv - std::sqrt(cos2)) - w * inv;
}

/// Unpolarised reflectance of a dielectric boundary; 1 on total reflection.
/// Source:  Fresnel's equations; Born, Wolf, "Principles of Optics", 1.5.
/// Checked: Fresnel.DielectricMatchesTheTable.
inline float fresnel_dielectric(float cos_o, float eta) {
  const float c = clamp01(cos_o);
  const float cos2 = 1 - (1 - c * c) / (eta * eta);
  if (cos2 <= 0) return 1;
  const float t = std::sqrt(cos2);
  const float s = (c - eta * t) / (c + eta * t);
  const float p = (eta * c - t) / (eta * c + t);
  return 0.5f * (s * s + p * p);
}

/// Same from the indices and the cosines on both sides; 1 if both are grazing.
/// Checked: Fresnel.FromBothCosines.
inline float fresnel_from_cosines(float ior_in, float ior_out, float cos_in, float cos_out) {
  const float s = ior_in * cos_in + ior_out * cos_out, p = ior_out * cos_in + ior_in * cos_out;
  if (s == 0 || p == 0) return 1;
  return 0.5f * (sqr((ior_in * cos_in - ior_out * cos_out) / s) +
                 sqr((ior_out * cos_in - ior_in * cos_out) / p));
}

/// Cosine-weighted mean of fresnel_dielectric over the hemisphere of the viewer's side.
/// Checked: Fresnel.MeanMatchesTheTableAndQuadrature.
float fresnel_dielectric_mean(float eta);

/// Reflectance of a lossless pane, including all bounces between its faces, from the reflectance r
/// of one face; the rest is transmitted.
/// Source: Stokes 1862, incoherent sum of the series.
inline float pane_reflectance(float r) { return 2 * r / (1 + r); }

/// User-defined reflectance by angle: `brdf_0_degree_refl`, `brdf_90_degree_refl`, `brdf_curve`.
/// Source:  Schlick, "An Inexpensive BRDF Model", 1994, with a free exponent.
/// Checked: Fresnel.CurveMatchesTheTable.
struct ReflectivityCurve {
  float at_0 = 0.2f;
  float at_90 = 1;
  float exponent = 5;

  float operator()(float cos_o) const {
    const float m = 1 - clamp01(cos_o);
    const float shape = exponent == 5 ? sqr(m * m) * m : math::pow(m, exponent);
    return at_0 + (at_90 - at_0) * shape;
  }
  /// Cosine-weighted mean over the hemisphere.
  float mean() const { return at_0 + 2 * (at_90 - at_0) / ((exponent + 1) * (exponent + 2)); }
};

}  // namespace oriel::bsdf
