// SPDX-License-Identifier: Apache-2.0
#include "render/prepare.h"

#include <fmt/format.h>

#include "render/lens_shaders.h"
#include "render/prepare_parts.h"
#include "scene/render_options.h"

namespace oriel {
namespace {

/// A volume shader as a lens acts on eye rays alone.
void bind_lens(const scene::Camera& camera, Binder& binder, World& world,
               Diagnostics& diagnostics) {
  for (const ShaderNode* node : binder.bind(camera.lens)) {
    const ShaderSpec& spec = node->spec();
    if (spec.lens) {
      // Each lens shader asks the next for the ray's colour and maps what comes back.
      world.lens.insert(world.lens.begin(), node);
      note_preview(*node, world);
    } else if (spec.lens_ray) {
      if (spec.lens_rays(*node) > 0) world.lens_rays.push_back(node);
    } else if (spec.volume)
      world.air_of_eye.push_back(node);
    else
      diagnostics.warning(
          "OR-RN-010", camera.where,
          fmt::format("lens shader \"{}\" does not act as a lens; skipped", node->spec().name));
  }
}

void bind_volume(const scene::Camera& camera, Binder& binder, World& world,
                 Diagnostics& diagnostics) {
  for (const ShaderNode* node : binder.bind(camera.volume)) {
    if (node->spec().volume)
      world.air.push_back(node);
    else
      diagnostics.warning(
          "OR-RN-011", camera.where,
          fmt::format("volume shader \"{}\" does not act as a volume; skipped", node->spec().name));
  }
}

}  // namespace

std::unique_ptr<World> prepare(scene::Scene& scene, const scene::RenderCommand& command,
                               const Registry& registry, const PrepareOptions& options,
                               Diagnostics& diagnostics, PrepareReport& report) {
  auto world = std::make_unique<World>();
  if (const auto* block = scene.get<scene::Options>(command.options))
    world->options = scene::interpret_options(*block, diagnostics);
  else
    diagnostics.warning(
        "OR-RN-002", command.where,
        fmt::format("there are no options \"{}\"; defaults are used", command.options));

  const std::vector<scene::Leaf> leaves =
      scene::flatten(scene, command.root, diagnostics, {},
                     scene::photon_flags(world->options.caustic.object_flags,
                                         world->options.globillum.object_flags));
  const scene::Camera* camera = nullptr;
  const std::string& camera_name = options.camera.empty() ? command.camera : options.camera;
  if (!place_camera(scene, leaves, camera_name, options, *world, camera, diagnostics))
    return nullptr;

  const LightNames light_names = place_lights(leaves, *world, diagnostics);
  Binder binder(scene, registry, *world, light_names, diagnostics);
  bind_lights(leaves, binder, *world, diagnostics);
  // The environment before materials: nothing in it depends on them.
  world->environment = EnvironmentLight(binder.bind(camera->environment), *world);
  if (world->options.lens) bind_lens(*camera, binder, *world, diagnostics);
  if (world->options.volume) bind_volume(*camera, binder, *world, diagnostics);
  place_geometry(scene, leaves, light_names, binder, options, *world, diagnostics, report);
  open_portals(*world);
  world->light_groups = group_lights(*world);

  report.binding = binder.report();
  report.lights = world->lights.size();
  report.instances = world->instances.size();
  return world;
}

}  // namespace oriel
