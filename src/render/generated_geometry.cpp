// SPDX-License-Identifier: Apache-2.0
#include "render/generated_geometry.h"

#include <fmt/format.h>

#include "runtime/binder.h"

namespace oriel {

void make_geometry(scene::Scene& scene, const scene::RenderOptions& options,
                   const Registry& registry, Diagnostics& diagnostics) {
  // By names: what is made is added to the list of elements.
  std::vector<std::string> names;
  for (const scene::Element& element : scene.elements())
    if (const auto* instance = std::get_if<scene::Instance>(&element);
        instance && !instance->geometry.empty())
      names.push_back(instance->name);
  if (names.empty()) return;

  World world;  // for the shaders' parameters alone
  world.options = options;
  const std::unordered_map<std::string, std::vector<int>> no_lights;
  Binder binder(scene, registry, world, no_lights, diagnostics);
  for (const std::string& name : names) {
    const scene::ShaderList list = scene.get<scene::Instance>(name)->geometry;
    const SourceLocation where = scene.get<scene::Instance>(name)->where;
    std::string made;
    for (const ShaderNode* node : binder.bind(list)) {
      if (!node->spec().geometry) {
        diagnostics.warning(
            "OR-RN-070", where,
            fmt::format("shader \"{}\" makes no geometry; skipped", node->spec().name));
        continue;
      }
      ShadingPoint point;
      point.ray_kind = RayKind::None;
      point.world = &world;
      made = node->with_params(
          point, [&](const Call& call) { return node->spec().geometry(call, scene); });
    }
    if (made.empty()) {
      diagnostics.warning("OR-RN-071", where,
                          fmt::format("instance \"{}\": its geometry shaders made nothing", name));
      continue;
    }
    auto* instance = scene.get<scene::Instance>(name);
    instance->element = made;
    instance->geometry.clear();
  }
}

}  // namespace oriel
