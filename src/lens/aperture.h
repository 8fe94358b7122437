// SPDX-License-Identifier: Apache-2.0
// Sampling of lens positions: round and bladed apertures, and apertures from a picture.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "sampling/distribution.h"

namespace oriel::lens {

/// The shape of an aperture, with importance sampling.
///
/// Model:   a disc of radius 1, or a polygon with corners on the unit circle, the first one at
///          `blade_angle`, counter-clockwise from +x. The distance of a sample from the centre,
///          relative to the rim in its direction, is u^(1 / (2 bias)): a bias of 1 is uniform,
///          smaller values concentrate samples at the centre, larger ones at the rim. Alternatively
///          a picture over [-1,1]^2: positions are sampled in proportion to its brightness, and
///          colours become weights. The brightness of objects in focus is unchanged in the dominant
///          channel of the picture.
/// Source:  the manual, section 3.2; the formula for bias is specific to Oriel.
/// Checked: Aperture.*
class Aperture {
 public:
  struct Sample {
    Vec2 point;  ///< x to the right, y up, seen from behind the camera
    Rgb weight;  ///< colour weight of the sample; the mean is 1 except for coloured pictures
  };

  /// Inputs:  blade_count: below 3 = round; blade_angle: 1 is a full turn; bias: 0 = all at the
  ///          centre.
  Aperture(int blade_count, float blade_angle, float bias);
  /// Inputs:  texels: rows from bottom to top. A black picture blocks all light.
  Aperture(std::span<const Rgb> texels, std::size_t width, std::size_t height);

  /// Inputs:  u: uniform in [0,1)^2.
  Sample sample(const Vec2& u) const;

 private:
  int blades_ = 0;
  float angle_ = 0, exponent_ = 0.5f;
  std::vector<Rgb> weights_;  ///< per texel; empty without a picture
  sampling::Distribution2D table_;
};

}  // namespace oriel::lens
