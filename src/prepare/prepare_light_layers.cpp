// SPDX-License-Identifier: Apache-2.0
#include "prepare/prepare_light_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>

namespace oriel {
namespace {

/// Matches names against the groups' patterns and records which patterns matched.
class GroupFinder {
 public:
  explicit GroupFinder(const std::vector<scene::LightGroup>& groups) : groups_(groups) {
    for (const scene::LightGroup& g : groups) used_.emplace_back(g.patterns.size(), false);
  }
  std::size_t none() const { return groups_.size(); }

  /// The first group with a matching pattern.
  std::size_t find(const std::string& name) {
    const auto [entry, is_new] = known_.try_emplace(name, none());
    if (!is_new) return entry->second;
    for (std::size_t g = groups_.size(); g-- > 0;)
      for (std::size_t p = 0; p < groups_[g].patterns.size(); ++p)
        if (scene::matches(groups_[g].patterns[p], name)) {
          used_[g][p] = true;
          entry->second = g;
        }
    return entry->second;
  }
  /// The first group that matches any name of an element.
  std::size_t find(const scene::Leaf& leaf) {
    std::size_t found = none();
    for (const scene::Instance* instance : leaf.chain) {
      found = std::min(found, find(instance->name));
      if (instance != leaf.chain.back()) found = std::min(found, find(instance->element));
    }
    for (const scene::Instance* instance : leaf.chain) names_.insert(instance->name);
    return found;
  }

  void report(Diagnostics& diagnostics) const {
    std::vector<std::string> names(names_.begin(), names_.end());
    names.emplace_back(scene::kEnvironmentName);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (std::size_t p = 0; p < groups_[g].patterns.size(); ++p) {
        if (used_[g][p]) continue;
        const std::string& pattern = groups_[g].patterns[p];
        std::string plain = pattern;
        std::erase_if(plain, [](char c) { return c == '*' || c == '?'; });
        const std::string near = nearest(plain, names);
        diagnostics.warning(
            "OR-RN-057", {},
            fmt::format("no light, emissive object or group of them matches \"{}\" of light group "
                        "\"{}\"",
                        pattern, groups_[g].name),
            fmt::format("the nearest name is \"{}\"", near));
      }
  }

 private:
  /// Nearest name: by edit distance, otherwise by the longest common beginning.
  static std::string nearest(const std::string& plain, const std::vector<std::string>& names) {
    if (std::string found = nearest_name(plain, names); !found.empty()) return found;
    const auto shared = [&](const std::string& name) {
      const auto ends = std::mismatch(name.begin(), name.end(), plain.begin(), plain.end());
      return ends.first - name.begin();
    };
    return *std::max_element(names.begin(), names.end(),
                             [&](const auto& a, const auto& b) { return shared(a) < shared(b); });
  }

  const std::vector<scene::LightGroup>& groups_;
  std::vector<std::vector<bool>> used_;
  std::unordered_map<std::string, std::size_t> known_;
  std::set<std::string> names_;  ///< names that patterns can match
};

}  // namespace

LightLayers resolve_light_layers(const std::vector<scene::Leaf>& leaves,
                                 const std::vector<scene::LightGroup>& asked, const World& world,
                                 const std::vector<EmissionKind>& emits, Diagnostics& diagnostics) {
  LightLayers layers;
  if (asked.empty()) return layers;
  std::vector<scene::LightGroup> groups = asked;
  if (groups.size() > scene::kMaxLightGroups) {
    diagnostics.warning("OR-RN-058", {},
                        fmt::format("{} groups of lights are too many: those after \"{}\" are left "
                                    "out",
                                    groups.size(), groups[scene::kMaxLightGroups - 1].name));
    groups.resize(scene::kMaxLightGroups);
  }
  for (const scene::LightGroup& g : groups) layers.names.push_back(g.name);
  GroupFinder finder(groups);
  layers.environment = static_cast<std::uint8_t>(finder.find(std::string(scene::kEnvironmentName)));
  layers.of_instance.assign(world.instances.size(), static_cast<std::uint8_t>(layers.rest()));
  std::size_t instance = 0;
  for (const scene::Leaf& leaf : leaves) {
    if (leaf.flags.hidden) continue;
    if (leaf.kind == scene::LeafKind::Light) {
      const Light& light = world.lights[layers.of_light.size()];
      std::size_t layer = finder.find(leaf);
      const bool shows_sky = light.portal && !light.portal->own_environment;
      if (layer == layers.rest() && shows_sky) layer = layers.environment;
      layers.of_light.push_back(static_cast<std::uint8_t>(layer));
    } else if (leaf.object()) {
      if (emits[instance] == EmissionKind::Source)
        layers.of_instance[instance] = static_cast<std::uint8_t>(finder.find(leaf));
      if (emits[instance] == EmissionKind::OfLights) {
        layers.of_instance[instance] = static_cast<std::uint8_t>(layers.unknown());
        layers.some_unknown = true;
      }
      ++instance;
    }
  }
  finder.report(diagnostics);
  return layers;
}

}  // namespace oriel
