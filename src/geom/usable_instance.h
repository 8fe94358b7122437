// SPDX-License-Identifier: Apache-2.0
// Whether rays can hit an instance: its matrices are finite and not singular.
#pragma once

#include <algorithm>
#include <cmath>

#include "geom/accel.h"

namespace oriel::geom {

inline bool is_usable(const Mat4& m) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column)
      if (!std::isfinite(m[row][column])) return false;
  return determinant3(m) != 0;
}

inline bool is_usable(const InstanceDesc& desc) {
  return is_usable(desc.local_to_world) && is_usable(desc.world_to_local) &&
         std::all_of(desc.path.begin(), desc.path.end(),
                     [](const Mat4& m) { return is_usable(m); });
}

}  // namespace oriel::geom
