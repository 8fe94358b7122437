// SPDX-License-Identifier: Apache-2.0
// Incident light of a hemisphere as a low-order polynomial, for blurred look-ups.
#pragma once

#include <array>
#include <span>

#include "base/frame.h"
#include "base/vec.h"

namespace oriel {

// Conventions
//   A hemisphere is divided into rings x sectors strata of equal cosine-weighted solid angle: ring
//   j covers sin^2(theta) in [j, j + 1] / rings, sector k covers phi in [k, k + 1] / sectors turns
//   from the frame's s towards t. Values are stored by ring: [ring * sectors + sector].

/// Integrals over solid angle of L times 1, the local x, y, z, and products of two of them.
struct HemisphereMoments {
  Rgb one{0}, x{0}, y{0}, z{0}, zz{0}, xz{0}, yz{0};
  Rgb xx_yy{0};  ///< of x^2 - y^2
  Rgb xy2{0};    ///< of 2 x y
};

/// Moments of radiance that is constant in each stratum. They are exact for such radiance, so no
/// moment has the factor 1 / cos of a cosine-weighted estimate.
HemisphereMoments hemisphere_moments(std::span<const Rgb> radiance, int rings, int sectors);

/// Incident radiance as a polynomial of second degree in the world direction: the nine spherical
/// harmonics of bands 0 to 2 in coordinates that rotate and interpolate without matrices.
///
///   L(w) = mean + linear . w + w^T Q w,  Q symmetric with trace 0
struct IncomingLight {
  Rgb mean{0};
  std::array<Rgb, 3> linear{Rgb(0), Rgb(0), Rgb(0)};
  /// xx, yy, xy, xz, yz of Q; zz is -(xx + yy).
  std::array<Rgb, 5> quadratic{Rgb(0), Rgb(0), Rgb(0), Rgb(0), Rgb(0)};

  /// Adds another polynomial times `weight`.
  void add(const IncomingLight& other, float weight);
};

/// The polynomial closest to the radiance with these moments.
///
/// Model:   least squares over the hemisphere. The other hemisphere is unknown; with a small weight
///          it is fitted to the mirrored one, so that lobes that extend below the horizon get
///          plausible values. Constant radiance is exact; a cosine lobe of peak 1 is within 0.12,
///          with a root mean square error of 0.05.
/// Checked: GatherLight.ConstantRadianceIsExactAtEveryRoughness,
///          GatherLight.CosineLobeIsNearlyExact.
IncomingLight fit_incoming(const HemisphereMoments& moments, const Frame& frame);

/// Radiance seen by a glossy lobe around a direction.
///
/// Model:   the polynomial convolved with a kernel exp(-l (l + 1) t / 2) in band l, where t = 2 a^2
///          / (1 + 4 a^2): for small roughness a this is the spread of reflections off Beckmann
///          slopes, at a = 1 almost a cosine lobe (exact factors 2/3 and 1/4, here 0.67 and 0.30).
///          Three bands resolve no feature narrower than about 60 degrees. Never negative.
/// Inputs:  direction: world, unit, away from the surface; roughness: alpha in [0, 1].
/// Checked: GatherLight.*
Rgb blurred_radiance(const IncomingLight& light, const Vec3& direction, float roughness);

}  // namespace oriel
