// SPDX-License-Identifier: Apache-2.0
#include "interactive/light_grouping.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "output/camera_output.h"
#include "scene/hierarchy.h"
#include "scene/render_options.h"

namespace oriel::interactive {
namespace {

/// Letters, digits, `_` and `-`; never a reserved name.
std::string group_name(const std::string& instance, const std::set<std::string>& used) {
  std::string name;
  for (const char c : instance)
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ? c : '_';
  if (name == scene::kRestGroup || name == scene::kIndirectGroup) name += "_";
  const std::string stem = name;
  for (int i = 2; used.contains(name); ++i) name = stem + "_" + std::to_string(i);
  return name;
}

/// Portals bring the light of the environment, to which they belong.
bool is_portal(const scene::Light& light) {
  return std::any_of(light.shaders.begin(), light.shaders.end(), [](const scene::ShaderUse& use) {
    return use.type.find("portal") != std::string::npos;
  });
}

}  // namespace

std::vector<scene::LightGroup> group_lights(const scene::Scene& scene,
                                            const scene::RenderCommand& command) {
  Diagnostics reported;  // when the world is prepared
  if (const auto* block = scene.get<scene::Options>(command.options))
    if (!scene::interpret_options(*block, reported).light_groups.empty()) return {};
  std::vector<scene::LightGroup> groups;
  std::set<std::string> used, instances;
  for (const scene::Leaf& leaf : scene::flatten(scene, command.root, reported)) {
    const std::string& instance = leaf.instance().name;
    if (leaf.kind != scene::LeafKind::Light || !instances.insert(instance).second) continue;
    if (is_portal(*leaf.light())) continue;
    // Patterns have no escape for their wildcards and commas.
    if (instance.find_first_of("*?,") != std::string::npos) continue;
    if (groups.size() == kMaxGroupedLights) break;
    groups.push_back({group_name(instance, used), {instance}});
    used.insert(groups.back().name);
  }
  const scene::Camera* camera = find_camera(scene, command);
  if (camera && !camera->environment.empty())
    groups.push_back({group_name(std::string(scene::kEnvironmentName), used),
                      {std::string(scene::kEnvironmentName)}});
  return groups;
}

}  // namespace oriel::interactive
