// SPDX-License-Identifier: Apache-2.0
#include "scene/value.h"

namespace oriel::scene {

bool operator==(const Value& a, const Value& b) {
  return a.kind == b.kind && a.boolean == b.boolean && a.integral == b.integral &&
         a.numbers == b.numbers && a.text == b.text && a.items == b.items && a.members == b.members;
}

bool operator==(const Argument& a, const Argument& b) {
  return a.name == b.name && a.value == b.value;
}

bool operator==(const Statement& a, const Statement& b) {
  return a.keyword == b.keyword && a.quoted == b.quoted && a.values == b.values;
}

}  // namespace oriel::scene
