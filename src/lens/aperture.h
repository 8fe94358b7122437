// SPDX-License-Identifier: Apache-2.0
// Where on a lens light comes in: round, bladed, or as a picture says.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "sampling/distribution.h"

namespace oriel::lens {

/// The shape of a lens opening, to be sampled.
///
/// Model:   a disc of radius 1, or the polygon whose corners lie on its rim, the first one at
///          `blade_angle`, counter-clockwise from +x. A sample's distance from the middle, as a
///          share of what the rim allows in its direction, is u^(1 / (2 bias)): 1 fills evenly,
///          less gathers in the middle, more at the rim. Or a picture over [-1,1]^2: places are
///          chosen in proportion to its brightness, colours become weights, so that what is sharp
///          keeps its brightness in the channel that the picture has most of.
/// Source:  the manual, section 3.2; the form of bias is ours.
/// Checked: Aperture.*
class Aperture {
 public:
  struct Sample {
    Vec2 point;  ///< x to the right, y up, as seen from behind the camera
    Rgb weight;  ///< of the light through it; mean 1 but for coloured pictures
  };

  /// Inputs:  blade_count: below 3 = round; blade_angle: 1 is a full turn; bias: 0 = all in the
  ///          middle.
  Aperture(int blade_count, float blade_angle, float bias);
  /// Inputs:  texels: row after row, the lowest first. A black picture lets nothing in.
  Aperture(std::span<const Rgb> texels, std::size_t width, std::size_t height);

  /// Inputs:  u: uniform in [0,1)^2.
  Sample sample(const Vec2& u) const;

 private:
  int blades_ = 0;
  float angle_ = 0, exponent_ = 0.5f;
  std::vector<Rgb> weights_;  ///< of each texel; empty without a picture
  sampling::Distribution2D table_;
};

}  // namespace oriel::lens
