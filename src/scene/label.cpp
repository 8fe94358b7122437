// SPDX-License-Identifier: Apache-2.0
#include "scene/label.h"

#include <algorithm>

namespace oriel::scene {

std::uint32_t label_of(const std::vector<Statement>& statements) {
  const Statement* tag = find_last(statements, "tag");
  if (!tag || tag->values.empty() || tag->values[0].numbers.empty()) return 0;
  return static_cast<std::uint32_t>(std::clamp(tag->values[0].numbers[0], 0.0, 4294967295.0));
}

}  // namespace oriel::scene
