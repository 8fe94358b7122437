// SPDX-License-Identifier: Apache-2.0
// The environment and the sampler of all lights.
#include "lights/emission.h"
#include "lights/find_openings.h"
#include "lights/light_sampler.h"
#include "lights/portal_table.h"
#include "prepare/prepare_light_layers.h"
#include "prepare/prepare_parts.h"

namespace oriel {

// The environment is bound before the materials; it does not depend on them.
void bind_environment(const scene::Camera& camera, Binder& binder, World& world) {
  world.environment = binder.bind(camera.environment);
  // Reports look at a few directions of the environment only.
  if (!world.coarse_tables)
    for (const auto& texture : world.textures) texture->keep_pixels();
  world.environment_textures = world.textures.size();
}

std::vector<EmissionKind> make_light_sampler(EnvironmentLight environment, KnownOpenings known,
                                             World& world) {
  world.has_tinted_portals = false;
  open_portals(world, environment.table().detail());
  std::vector<EmissionKind> emissive = emissive_materials(world);
  if (!known.all)
    known.all = world.coarse_tables ? Openings()
                                    : find_openings(world, environment, std::move(known.found));
  world.light_sampler = std::make_shared<const LightSampler>(
      world, std::move(environment), mesh_lights_of(world, emissive), *std::move(known.all));
  return emissive;
}

void make_light_layers(const std::vector<scene::Leaf>& leaves, const PrepareOptions& options,
                       const std::vector<EmissionKind>& emissive, World& world,
                       Diagnostics& diagnostics) {
  std::vector<scene::LightGroup> groups = options.light_groups;
  for (const scene::LightGroup& g : world.options.light_groups)
    if (std::none_of(groups.begin(), groups.end(), [&](auto& o) { return o.name == g.name; }))
      groups.push_back(g);
  if (groups.empty()) return;
  const std::vector<EmissionKind> emits = emissive_instances(world, emissive);
  world.light_layers = resolve_light_layers(leaves, groups, world, emits, diagnostics);
}

void complete_light_sampler(World& world) {
  if (!world.draft_environment && !world.draft_openings) return;
  const auto draft = std::exchange(world.light_sampler, nullptr);
  EnvironmentLight environment =
      world.draft_environment ? EnvironmentLight(world) : draft->environment();
  KnownOpenings known;
  if (!world.draft_openings) known.found = draft->openings().found();
  world.draft_environment = world.draft_openings = false;
  make_light_sampler(std::move(environment), std::move(known), world);
}

}  // namespace oriel
