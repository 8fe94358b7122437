// SPDX-License-Identifier: Apache-2.0
// Sheen: light that the fibres of cloth scatter at grazing angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

inline constexpr float kMinSheenAlpha = 0.01f;

/// White sheen.
///
/// Model:   D G / (4 cos cos) with the "Charlie" distribution D = (2 + 1/alpha) sin^(1/alpha) / 2
///          pi and the height-correlated fit of G without its softened terminator. Reciprocal.
/// Inputs:  alpha: width, kMinSheenAlpha..1.
/// Source:  Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 courses;
///          KHR_materials_sheen.
/// Checked: Sheen.* and the contract suite.
class Sheen {
 public:
  explicit Sheen(float alpha);

  float eval(const Vec3& wo, const Vec3& wi) const;
  /// Uniform over the hemisphere: the lobe is wide, and zero along the normal.
  float pdf(const Vec3& wo, const Vec3& wi) const { return wo.z > 0 && wi.z > 0 ? 1 / kTwoPi : 0; }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    const float radius = std::sqrt(std::max(0.0f, 1 - u2.x * u2.x)), turn = kTwoPi * u2.y;
    const Vec3 wi(radius * math::cos(turn), radius * math::sin(turn), u2.x);
    return LobeSample{wi, eval(wo, wi) * kTwoPi, 1 / kTwoPi, false};
  }

 private:
  float lambda(float cosine) const;

  float exponent_, peak_;
  float a_, b_, c_, d_, e_, middle_;  // of the fit of G, and its value at a cosine of one half
};

/// Directional albedo of Sheen(alpha); above 1 at grazing angles if alpha is small.
///
/// Model:   a table over the roots of cosine and alpha, integrated at the first call; its
///          error is at most .005 for alpha of .04 and more.
/// Checked: Sheen.AlbedoIsTheIntegral
float sheen_albedo(float alpha, float cosine);

}  // namespace oriel::bsdf
