// SPDX-License-Identifier: Apache-2.0
#include "scene/object.h"

namespace oriel::scene {

bool Object::tagged() const {
  const Statement* s = find_last(flags, "tagged");
  return s && (s->values.empty() || s->values[0].boolean);
}

}  // namespace oriel::scene
