// SPDX-License-Identifier: Apache-2.0
// Light layers: groups of lights whose contributions are stored separately.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/light_group.h"

namespace oriel {

/// Layers are numbered: the groups as they were named, then the rest, then what does not know.
/// Groups that overlap: a light belongs to the first. Portals that show the scene's environment and
/// that no pattern names are the environment's.
struct LightLayers {
  std::vector<std::string> names;  ///< of the groups; empty = not requested
  // By index into World::lights and World::instances, empty when not requested.
  std::vector<std::uint8_t> of_light, of_instance;
  std::uint8_t environment = 0;
  bool some_unknown = false;  ///< some surfaces show light that their shaders asked for

  bool asked() const { return !names.empty(); }
  /// Light of no group: of other lights, and light without a source.
  std::size_t rest() const { return names.size(); }
  /// Light that was worked out without knowing whose it is.
  std::size_t unknown() const { return names.size() + 1; }
  std::size_t count() const { return names.size() + 2; }
};
inline constexpr std::size_t kMaxLightLayers = scene::kMaxLightGroups + 2;

/// Light by layer. Not set until clear().
struct LightParts {
  std::array<Rgb, kMaxLightLayers> of;
  void clear(std::size_t count) { std::fill_n(of.begin(), count, Rgb(0)); }
  Rgb* data() { return of.data(); }
};

}  // namespace oriel
