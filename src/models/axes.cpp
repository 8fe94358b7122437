// SPDX-License-Identifier: Apache-2.0
#include "models/axes.h"

#include <assimp/scene.h>

#include <array>
#include <cstdint>
#include <string>

namespace oriel::models {
namespace {

/// A coordinate axis of the file (0 x, 1 y, 2 z) and its sign.
struct Axis {
  std::int32_t index = -1, sign = 1;
  bool valid() const { return index >= 0 && index < 3 && (sign == 1 || sign == -1); }
};

Axis axis(const aiMetadata& settings, const std::string& name) {
  Axis axis;
  settings.Get(name + "Axis", axis.index);
  settings.Get(name + "AxisSign", axis.sign);
  return axis;
}

}  // namespace

Mat4 upright(const aiScene& model, std::optional<char> up) {
  Mat4 to_scene;
  if (up == 'z') return Mat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
  if (up || !model.mMetaData) return to_scene;
  const std::array<Axis, 3> axes{axis(*model.mMetaData, "Coord"), axis(*model.mMetaData, "Up"),
                                 axis(*model.mMetaData, "Front")};
  unsigned named = 0;
  for (const Axis& a : axes)
    if (a.valid()) named |= 1u << a.index;
  if (named != 7) return to_scene;  // all three axes are given
  for (int to = 0; to < 3; ++to) {
    const Axis& a = axes[static_cast<std::size_t>(to)];
    for (int k = 0; k < 3; ++k) to_scene[a.index][k] = k == to ? static_cast<float>(a.sign) : 0.0f;
  }
  return to_scene;
}

}  // namespace oriel::models
