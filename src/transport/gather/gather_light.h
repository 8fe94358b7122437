// SPDX-License-Identifier: Apache-2.0
// Light arriving at a point from a hemisphere, few numbers: enough to ask for it blurred.
#pragma once

#include <array>
#include <span>

#include "base/frame.h"
#include "base/vec.h"

namespace oriel {

// Conventions
//   A hemisphere is cut into rings x sectors strata of equal cosine-weighted solid angle: ring j
//   spans sin^2(theta) in [j, j + 1] / rings, sector k spans phi in [k, k + 1] / sectors turns of
//   the frame's s towards t. Values are laid out ring by ring: [ring * sectors + sector].

/// Integrals of L times 1, the local x, y, z and products of two of them, over solid angle.
struct HemisphereMoments {
  Rgb one{0}, x{0}, y{0}, z{0}, zz{0}, xz{0}, yz{0};
  Rgb xx_yy{0};  ///< of x^2 - y^2
  Rgb xy2{0};    ///< of 2 x y
};

/// Moments of radiance that is constant in each stratum; exact for such radiance, so no moment has
/// the 1 / cos of a cosine-weighted estimate in it.
HemisphereMoments hemisphere_moments(std::span<const Rgb> radiance, int rings, int sectors);

/// Incoming radiance as a polynomial of second degree in the world direction: the nine spherical
/// harmonics of bands 0 to 2 in other coordinates, which turn and mix without matrices.
///
///   L(w) = mean + linear . w + w^T Q w,  Q symmetric with trace 0
struct IncomingLight {
  Rgb mean{0};
  std::array<Rgb, 3> linear{Rgb(0), Rgb(0), Rgb(0)};
  /// Q's xx, yy, xy, xz, yz; zz is -(xx + yy).
  std::array<Rgb, 5> quadratic{Rgb(0), Rgb(0), Rgb(0), Rgb(0), Rgb(0)};

  /// Adds `weight` times another.
  void add(const IncomingLight& other, float weight);
};

/// The polynomial that is nearest to the radiance whose moments these are.
///
/// Model:   least squares over the hemisphere. The other hemisphere is unknown: it is asked, with
///          little weight, to mirror the known one, so that lobes that dip below the horizon
///          read something sensible. Constant radiance is kept exactly; a cosine lobe of peak 1
///          within 0.12, 0.05 in the root mean square.
/// Checked: GatherLight.ConstantRadianceIsKeptAtEveryRoughness,
///          GatherLight.CosineLobeIsNearlyKept.
IncomingLight fit_incoming(const HemisphereMoments& moments, const Frame& frame);

/// Radiance seen by a glossy lobe around a direction.
///
/// Model:   the polynomial convolved with a kernel exp(-l (l + 1) t / 2) in band l, where
///          t = 2 a^2 / (1 + 4 a^2): for small roughness a the spread of the reflections off
///          Beckmann slopes, at a = 1 nearly a cosine lobe (exact factors 2/3 and 1/4, here 0.67
///          and 0.30). Three bands show no feature narrower than about 60 degrees, whatever the
///          roughness. Never negative.
/// Inputs:  direction: world, unit, away from the surface; roughness: alpha in [0, 1].
/// Checked: GatherLight.*
Rgb blurred_radiance(const IncomingLight& light, const Vec3& direction, float roughness);

}  // namespace oriel
