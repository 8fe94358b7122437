// SPDX-License-Identifier: Apache-2.0
// A normalised diffusion profile: where light that enters a scattering solid leaves it.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::bsdf {

/// Density per area of the distance between entry and exit of light, normalised over the plane.
///
/// Model:   (exp(-r / d) + exp(-r / 3d)) / (8 pi d r), cut off at `radius` and normalised again.
///          d = radius / 8, for which the cut removes 5 %.
/// Inputs:  radius > 0, r >= 0, in the same unit.
/// Source:  P. Christensen, B. Burley, "Approximate Reflectance Profiles for Efficient Subsurface
///          Scattering", Pixar Technical Memo 15-04, 2015, equation 2.
/// Checked: DiffusionProfile.*
class DiffusionProfile {
 public:
  explicit DiffusionProfile(float radius)
      : radius_(radius), d_(radius / 8), narrow_(share(d_) / 4), wide_(share(3 * d_) * 3 / 4) {}

  float radius() const { return radius_; }
  /// Per area. Finite at 0: distances below a millionth of the radius count as that.
  float eval(float r) const {
    if (r > radius_) return 0;
    const float at = std::max(r, 1e-6f * radius_);
    return (math::exp(-at / d_) + math::exp(-at / (3 * d_))) /
           (8 * kPi * d_ * at * (narrow_ + wide_));
  }
  /// Samples a distance; its density per area is eval().
  float sample(float u) const {
    const float chosen = u * (narrow_ + wide_);
    const float d = chosen < narrow_ ? d_ : 3 * d_;
    const float rest = chosen < narrow_ ? chosen / narrow_ : (chosen - narrow_) / wide_;
    return std::min(radius_, -d * math::log1p(-rest * share(d)));
  }

 private:
  /// Of an exponential with mean d, within the radius.
  float share(float d) const { return 1 - math::exp(-radius_ / d); }

  float radius_, d_, narrow_, wide_;
};

}  // namespace oriel::bsdf
