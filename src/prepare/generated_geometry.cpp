// SPDX-License-Identifier: Apache-2.0
#include "prepare/generated_geometry.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "runtime/binder.h"

namespace oriel {
namespace {

/// Maximum nesting of geometry shaders that create instances with geometry shaders; deeper nesting
/// would be endless.
constexpr int kMaxDepth = 64;

/// Returns the names of instances with geometry shaders that are not in `done`, and adds them.
/// Names, since new elements are appended to the list.
std::vector<std::string> generated(const scene::Scene& scene, std::set<std::string>& done) {
  std::vector<std::string> names;
  for (const scene::Element& element : scene.elements())
    if (const auto* instance = std::get_if<scene::Instance>(&element);
        instance && !instance->geometry.empty() && done.insert(instance->name).second)
      names.push_back(instance->name);
  return names;
}

}  // namespace

void make_geometry(scene::Scene& scene, const scene::RenderOptions& options,
                   const Registry& registry, Diagnostics& diagnostics) {
  std::set<std::string> done;
  std::vector<std::string> names = generated(scene, done);
  if (names.empty()) return;

  World world;  // only for the shaders' parameters
  world.options = options;
  const std::unordered_map<std::string, std::vector<int>> no_lights;
  Binder binder(scene, registry, world, no_lights, diagnostics);
  // Created geometry may contain geometry shaders.
  for (int depth = 0; depth < kMaxDepth && !names.empty(); ++depth) {
    for (const std::string& name : names) {
      const auto* asked = scene.get<scene::Instance>(name);
      if (!asked) continue;  // another shader removed it
      const scene::ShaderList list = asked->geometry;
      const SourceLocation where = asked->where;
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
        diagnostics.warning(
            "OR-RN-071", where,
            fmt::format("instance \"{}\": its geometry shaders made nothing", name));
        continue;
      }
      auto* instance = scene.get<scene::Instance>(name);
      if (!instance) continue;  // its shader removed it
      instance->element = made;
      instance->geometry.clear();
    }
    names = generated(scene, done);
  }
}

}  // namespace oriel
