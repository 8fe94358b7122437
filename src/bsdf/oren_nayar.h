// SPDX-License-Identifier: Apache-2.0
// Oren-Nayar diffuse reflection.
#pragma once

#include <algorithm>
#include <optional>

#include "bsdf/lobe_sample.h"
#include "sampling/warp.h"

namespace oriel::bsdf {

/// White diffuse reflection with roughness sigma.
///
/// Model:   the qualitative model of Oren and Nayar; roughness 0 is exactly Lambert. For small
///          sigma the published model reflects up to 1.3 % more than it receives at grazing angles.
///          It is divided by that maximum, which depends on sigma only and so preserves
///          reciprocity.
/// Inputs:  sigma: standard deviation of the facets' slope angle, rad, >= 0 (`diffuse_roughness`).
/// Source:  Oren, Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, eq. 30.
/// Checked: OrenNayar.AlbedoMatchesTheClosedForm, OrenNayar.NeverReflectsMoreThanItReceives.
class OrenNayar {
 public:
  explicit OrenNayar(float sigma = 0) {
    if (sigma == 0) return;
    const float s2 = sigma * sigma;
    const float a = 1 - 0.5f * s2 / (s2 + 0.33f);
    const float b = 0.45f * s2 / (s2 + 0.09f);
    // The albedo tends to A + B / 2 at grazing angles, which is its maximum if it exceeds 1.
    const float scale = 1 / std::max(1.0f, a + 0.5f * b);
    a_ = a * scale;
    b_ = b * scale;
  }

  /// Coefficients A and B of the model after the division.
  float a() const { return a_; }
  float b() const { return b_; }

  float eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    float f = a_;
    if (b_ > 0) {
      // cos(difference of azimuth) sin(wo) sin(wi); sin * tan of the model is this divided by the
      // larger cosine.
      const float c = wo.x * wi.x + wo.y * wi.y;
      if (c > 0) f += b_ * c / std::max(wo.z, wi.z);
    }
    return f * wi.z * kInvPi;
  }

  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z > 0 ? sampling::cosine_hemisphere_pdf(wi.z) : 0;
  }

  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float) const {
    if (wo.z <= 0) return std::nullopt;
    const Vec3 wi = sampling::sample_cosine_hemisphere(u2);
    const float density = sampling::cosine_hemisphere_pdf(wi.z);
    return LobeSample{wi, eval(wo, wi) / density, density, false};
  }

  /// Directional albedo for a viewer at cosine cos_o, in closed form.
  float albedo(float cos_o) const;

 private:
  float a_ = 1, b_ = 0;
};

}  // namespace oriel::bsdf
