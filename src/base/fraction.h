// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace oriel {

/// The distance to the next integer below: in [0, 1], 1 only by rounding of a small negative x.
inline float fraction(float x) { return x - std::floor(x); }

}  // namespace oriel
