// SPDX-License-Identifier: Apache-2.0
#include "scene/sun_shaders.h"

namespace oriel::scene {
namespace {

/// References from shader to shader that are followed; they may refer to each other in a circle.
constexpr int kMaxSunReferences = 16;

const ShaderUse* find_sun(const Scene& scene, const ShaderList& list, int depth) {
  for (const ShaderUse& use : list) {
    if (use.type == "mia_physicalsun") return &use;
    const auto* named = scene.get<ShaderElement>(use.reference);
    if (!named || depth >= kMaxSunReferences) continue;
    if (const ShaderUse* found = find_sun(scene, named->functions, depth + 1)) return found;
  }
  return nullptr;
}

}  // namespace

bool is_sky_shader(const std::string& type) {
  return type == "mia_physicalsky" || type == "mia_ciesky";
}

bool is_y_up(const ShaderUse& use) {
  for (const Argument& argument : use.arguments)
    if (argument.name == "y_is_up")
      return argument.value.kind == Value::Kind::Numbers
                 ? !argument.value.numbers.empty() && argument.value.numbers[0] != 0
                 : argument.value.boolean;
  return false;
}

const ShaderUse* find_sun(const Scene& scene, const ShaderList& list) {
  return find_sun(scene, list, 0);
}

}  // namespace oriel::scene
