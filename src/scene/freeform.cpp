// SPDX-License-Identifier: Apache-2.0
#include "scene/freeform.h"

namespace oriel::scene {

std::size_t Basis::control_points(std::size_t parameters) const {
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (kind == Kind::BSpline) return parameters > order ? parameters - order : 0;
  if (parameters < 2 || degree < 0) return 0;
  const std::size_t segments = parameters - 1;
  switch (kind) {
    case Kind::Taylor:
      return segments * order;
    case Kind::Cardinal:
      return segments + 3;
    case Kind::Matrix:
      return (segments - 1) * static_cast<std::size_t>(step) + order;
    default:
      return segments * (order - 1) + 1;
  }
}

}  // namespace oriel::scene
