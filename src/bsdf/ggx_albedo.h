// SPDX-License-Identifier: Apache-2.0
// Single-scattering albedo of a white GGX surface, for multiple-scattering compensation.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace oriel::bsdf {

/// Directional albedo of single scattering on a white GGX surface; light scattered below the
/// horizon counts as lost.
///
/// Model:   quadratic B-splines, fitted to quadrature by tools/generate_ggx_albedo.cpp; within 0.4
///          % for axis ratios up to 10.
/// Inputs:  ax, ay in (0, kMaxAlpha]; wo unit, local frame, wo.z > 0.
/// Returns: in (0, 1].
/// Errors:  none; arguments are clamped to the range.
/// Checked: GgxAlbedo.TableIsTheGeneratorsOutput, GgxAlbedo.MatchesQuadrature.
float ggx_albedo(float ax, float ay, const Vec3& wo);

/// Coordinates of the table, shared with its generator.
struct GgxAlbedoCoordinates {
  static constexpr int kCells[3] = {12, 6, 6};
  static constexpr int kNodes[3] = {kCells[0] + 2, kCells[1] + 2, kCells[2] + 2};
  static constexpr int kTerms = 4;
  static constexpr int kValues = kNodes[0] * kNodes[1] * kNodes[2] * kTerms;
  static constexpr float kLargest = 1.2f;
  static constexpr float kSmallestSkew = 0.19f;  // axes 1 : 10, viewed along the diagonal

  int cell[3];
  float weight[3][3];  // weights of the three nodes of the cell, per axis
  float term[kTerms];  // Chebyshev polynomials of the skew

  /// Roughness along and across the plane of the viewer, and a skew, which is 1 if a roughness axis
  /// is in that plane. The angle is parametrised by z / (z + along sin), for which the loss at
  /// grazing angles has a similar shape for all roughness values.
  GgxAlbedoCoordinates(float ax, float ay, const Vec3& wo) {
    const float sin2 = wo.x * wo.x + wo.y * wo.y;
    const float cos2_phi = sin2 > 1e-12f ? wo.x * wo.x / sin2 : 1;
    const float xx = ax * ax, yy = ay * ay;
    const float along = std::sqrt(lerp(yy, xx, cos2_phi));
    const float across = std::sqrt(lerp(xx, yy, cos2_phi));
    const float x = wo.z / (wo.z + along * std::sqrt(sin2));
    set(x, along, across, ax * ay / (along * across));
  }
  GgxAlbedoCoordinates(float x, float along, float across, float skew) {
    set(x, along, across, skew);
  }

 private:
  void set(float x, float along, float across, float skew) {
    const float position[3] = {std::sqrt(clamp01(x)), std::sqrt(clamp01(along / kLargest)),
                               std::sqrt(clamp01(across / kLargest))};
    for (int a = 0; a < 3; ++a) {
      const float p = position[a] * static_cast<float>(kCells[a]);
      cell[a] = std::min(static_cast<int>(p), kCells[a] - 1);
      const float f = p - static_cast<float>(cell[a]);
      weight[a][0] = 0.5f * sqr(1 - f);
      weight[a][1] = 0.5f + f * (1 - f);
      weight[a][2] = 0.5f * sqr(f);
    }
    const float t =
        2 * (clamp(skew, kSmallestSkew, 1.0f) - kSmallestSkew) / (1 - kSmallestSkew) - 1;
    term[0] = 1;
    term[1] = t;
    term[2] = 2 * t * t - 1;
    term[3] = (4 * t * t - 3) * t;
  }
};

}  // namespace oriel::bsdf
