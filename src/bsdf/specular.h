// SPDX-License-Identifier: Apache-2.0
// Delta lobes: mirror, clear refraction, clear thin sheet.
#pragma once

#include <optional>

#include "bsdf/fresnel.h"
#include "bsdf/lobe_sample.h"

namespace oriel::bsdf {

/// Perfect mirror.
struct Mirror {
  float eval(const Vec3&, const Vec3&) const { return 0; }
  float pdf(const Vec3&, const Vec3&) const { return 0; }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2&, float) const {
    if (wo.z <= 0) return std::nullopt;
    return LobeSample{Vec3(-wo.x, -wo.y, wo.z), 1, 1, true};
  }
};

/// Clear refraction into a medium; on total internal reflection the mirror direction.
/// Inputs:  eta: index of the far side over the viewer's side.
/// Checked: Refraction.TotalReflectionBeginsAtTheCriticalAngle.
struct ClearRefraction {
  float eta = 1;

  float eval(const Vec3&, const Vec3&) const { return 0; }
  float pdf(const Vec3&, const Vec3&) const { return 0; }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2& u2, float u1) const {
    if (wo.z <= 0) return std::nullopt;
    const auto wi = refract(wo, Vec3(0, 0, 1), eta);
    return wi ? LobeSample{*wi, 1, 1, true} : Mirror{}.sample(wo, u2, u1);
  }
};

/// A sheet without thickness; light passes undeflected.
struct ClearThinTransmission {
  float eval(const Vec3&, const Vec3&) const { return 0; }
  float pdf(const Vec3&, const Vec3&) const { return 0; }
  std::optional<LobeSample> sample(const Vec3& wo, const Vec2&, float) const {
    if (wo.z <= 0) return std::nullopt;
    return LobeSample{-wo, 1, 1, true};
  }
};

}  // namespace oriel::bsdf
