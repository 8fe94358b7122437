// SPDX-License-Identifier: Apache-2.0
#include "interactive/sun_edits.h"

#include <fmt/format.h>

#include <set>

#include "scene/hierarchy.h"
#include "scene/sun_shaders.h"

namespace oriel::interactive {
namespace {

std::string direction_text(const Vec3& d) { return fmt::format("{} {} {}", d.x, d.y, d.z); }

const scene::ShaderUse* find_sky(const scene::ShaderList& list) {
  for (const scene::ShaderUse& use : list)
    if (scene::is_sky_shader(use.type)) return &use;
  return nullptr;
}

const scene::ShaderUse* sky_of(const scene::Element& element) {
  if (const auto* shader = std::get_if<scene::ShaderElement>(&element))
    return find_sky(shader->functions);
  if (const auto* camera = std::get_if<scene::Camera>(&element))
    return find_sky(camera->environment);
  return nullptr;
}

}  // namespace

std::vector<std::string> sun_edits(const scene::Scene& scene, const std::string& root,
                                   const sky::SolarPosition& sun, double north,
                                   std::optional<double> haze) {
  std::vector<std::string> edits;
  const auto add_haze = [&](const std::string& name) {
    if (haze) edits.push_back(fmt::format("{}.haze={}", name, *haze));
  };
  Diagnostics reported;  // when the scene was prepared
  std::set<std::string> lights;
  for (const scene::Leaf& leaf : scene::flatten(scene, root, reported)) {
    if (leaf.kind != scene::LeafKind::Light || lights.contains(leaf.light()->name)) continue;
    const scene::ShaderUse* use = scene::find_sun(scene, leaf.light()->shaders);
    if (!use) continue;
    lights.insert(leaf.light()->name);
    const Vec3 to_sun =
        sky::direction_to_sun(sun.azimuth, sun.elevation, north, scene::is_y_up(*use));
    const Vec3 local = normalize(transform_vector(-to_sun, leaf.world_to_local));
    edits.push_back(leaf.light()->name + ".direction=" + direction_text(local));
    add_haze(leaf.light()->name);
  }
  for (const scene::Element& element : scene.elements()) {
    const scene::ShaderUse* use = sky_of(element);
    if (!use) continue;
    const Vec3 to_sun =
        sky::direction_to_sun(sun.azimuth, sun.elevation, north, scene::is_y_up(*use));
    const std::string& name = scene::name_of(element);
    edits.push_back(name + ".sun_direction=" + direction_text(to_sun));
    if (use->type == "mia_physicalsky") add_haze(name);
  }
  return edits;
}

}  // namespace oriel::interactive
