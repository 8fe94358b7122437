// SPDX-License-Identifier: Apache-2.0
#include "scene/object.h"

namespace oriel::scene {

bool Object::tagged() const {
  const Statement* s = find_last(flags, "tagged");
  if (!s) return false;
  if (s->values.empty()) return true;
  const Value& v = s->values[0];
  return v.kind == Value::Kind::Numbers ? !v.numbers.empty() && v.numbers[0] != 0 : v.boolean;
}

}  // namespace oriel::scene
