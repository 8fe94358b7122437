// SPDX-License-Identifier: Apache-2.0
// The anisotropic GGX microsurface: normal distribution, shadowing-masking, visible normals.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "sampling/warp.h"

namespace oriel::bsdf {

/// A microsurface with roughness ax along x and ay along y of the local frame.
///
/// Model:   GGX (Trowbridge-Reitz) distribution, height-correlated Smith shadowing.
/// Inputs:  ax, ay > 0, see gloss.h for the useful range. wo, wi, h unit, local frame.
/// Errors:  total.
/// Source:  Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
///          JCGT 3(2), 2014, eq. 85-87, 99; Dupuy, Benyoub, "Sampling Visible GGX Normals with
///          Spherical Caps", HPG 2023.
/// Checked: Ggx.ProjectedAreaIsOne, Ggx.VisibleNormalsMatchTheirDensity.
struct Ggx {
  float ax, ay;

  /// Length of v after scaling the surface to roughness 1. Shadowing functions are ratios of it:
  /// G1(v) = 2 v.z / (v.z + stretched(v)).
  float stretched(const Vec3& v) const {
    return std::sqrt(sqr(ax * v.x) + sqr(ay * v.y) + sqr(v.z));
  }
  float lambda(const Vec3& v) const { return 0.5f * (stretched(v) / std::abs(v.z) - 1); }
  float g1(const Vec3& v) const { return 1 / (1 + lambda(v)); }
  /// Height-correlated masking and shadowing for two directions above the surface.
  float g2(const Vec3& wo, const Vec3& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// Normal distribution; its projection on the plane integrates to 1.
  float d(const Vec3& h) const {
    if (h.z <= 0) return 0;
    const float q = sqr(h.x / ax) + sqr(h.y / ay) + sqr(h.z);
    return 1 / (kPi * ax * ay * q * q);
  }

  /// Samples a normal in proportion to its visible area.
  Vec3 sample_visible(const Vec3& wo, const Vec2& u) const {
    const Vec3 v = normalize(Vec3(ax * wo.x, ay * wo.y, wo.z));
    // Reflections of v on the hemisphere are uniform in a spherical cap; the normal is the half
    // vector.
    const sampling::SinCos phi = sampling::sincos_turns(u.x);
    const float z = (1 - u.y) * (1 + v.z) - v.z;
    const float r = std::sqrt(clamp01(1 - z * z));
    const Vec3 h(r * phi.cos + v.x, r * phi.sin + v.y, z + v.z);
    return normalize(Vec3(ax * h.x, ay * h.y, std::max(h.z, 1e-7f)));
  }
  /// Density of sample_visible per solid angle of normals: G1(wo) max(0, wo.h) D(h) / wo.z.
  float visible_pdf(const Vec3& wo, const Vec3& h) const {
    return 2 * std::max(0.0f, dot(wo, h)) * d(h) / (wo.z + stretched(wo));
  }
};

inline Vec3 reflect(const Vec3& w, const Vec3& h) { return h * (2 * dot(w, h)) - w; }

}  // namespace oriel::bsdf
