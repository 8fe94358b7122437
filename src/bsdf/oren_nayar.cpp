// SPDX-License-Identifier: Apache-2.0
#include "bsdf/oren_nayar.h"

#include <cmath>

#include "base/math.h"

namespace oriel::bsdf {

// The azimuth integrates to 2 over the facing half. The remaining integrand is sin(max) tan(min)
// cos sin over the polar angle, split at that of the viewer.
float OrenNayar::albedo(float cos_o) const {
  const float c = clamp(cos_o, 1e-6f, 1.0f);
  const float s = std::sqrt(1 - c * c);
  const float below = 0.5f * s * (math::acos(c) - s * c);
  const float above = s / c * (1 - s * s * s) / 3;
  return a_ + 2 * kInvPi * b_ * (below + above);
}

}  // namespace oriel::bsdf
