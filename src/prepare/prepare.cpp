// SPDX-License-Identifier: Apache-2.0
#include "prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>

#include "lights/emission.h"
#include "lights/find_openings.h"
#include "lights/light_sampler.h"
#include "lights/portal_table.h"
#include "prepare/generated_geometry.h"
#include "prepare/prepare_light_layers.h"
#include "prepare/prepare_parts.h"
#include "prepare/textures_ahead.h"
#include "runtime/color_mapping.h"
#include "runtime/fallback_shader.h"
#include "scene/render_options.h"

namespace oriel {
namespace {

/// A volume shader in the lens list acts on camera rays only.
void bind_lens(const scene::Camera& camera, Binder& binder, World& world,
               Diagnostics& diagnostics) {
  for (const ShaderNode* node : binder.bind(camera.lens)) {
    const ShaderSpec& spec = node->spec();
    if (spec.lens.trace) {
      world.lens_rays.push_back(node);
    } else if (spec.lens.map_color) {
      // A lens shader maps the colour returned by the next one, so they are applied in reverse
      // order.
      world.lens.insert(world.lens.begin(), node);
      note_preview(*node, world);
    } else if (spec.lens.bend_ray) {
      if (spec.lens.ray_count(*node) > 0) world.lens_rays.push_back(node);
    } else if (spec.volume.evaluate)
      world.eye_volume.push_back(node);
    else if (!is_substitute(spec))
      diagnostics.warning(
          "OR-RN-010", camera.where,
          fmt::format("lens shader \"{}\" does not act as a lens; skipped", node->spec().name));
  }
}

void bind_volume(const scene::Camera& camera, Binder& binder, World& world,
                 Diagnostics& diagnostics) {
  for (const ShaderNode* node : binder.bind(camera.volume)) {
    const ShaderSpec& spec = node->spec();
    if (spec.volume.evaluate) {
      world.camera_volume.push_back(node);
      if (spec.volume.dims_light && spec.volume.dims_light(*node))
        world.light_volume.push_back(node);
    } else if (!is_substitute(spec)) {
      diagnostics.warning(
          "OR-RN-011", camera.where,
          fmt::format("volume shader \"{}\" does not act as a volume; skipped", spec.name));
    }
  }
}

void bind_state_shaders(const scene::Options& options, Binder& binder, World& world,
                        Diagnostics& diagnostics) {
  for (const ShaderNode* node : binder.bind(options.state)) {
    if (node->spec().around_sample)
      world.state_shaders.push_back(node);
    else if (!is_substitute(node->spec()))
      diagnostics.warning(
          "OR-RN-012", options.where,
          fmt::format("\"{}\" does not act as a state shader; skipped", node->spec().name));
  }
}

/// Number of components of a buffer type: `rgba`, `s_fp`, `n`...
UserBuffer::Kind kind_of_buffer(std::string_view type) {
  const std::string_view stem = type.substr(0, type.find('_'));
  if (stem == "s" || stem == "z" || stem == "a" || stem == "depth") return UserBuffer::Kind::Scalar;
  if (stem == "n" || stem == "m" || stem == "normal" || stem == "motion")
    return UserBuffer::Kind::Vector;
  return UserBuffer::Kind::Color;
}

/// Buffers of the options have numbers, those of the camera have names.
std::vector<UserBuffer> user_buffers(const scene::RenderOptions& options,
                                     const scene::Camera& camera) {
  std::vector<UserBuffer> buffers;
  for (const scene::UserFrameBuffer& b : options.frame_buffers)
    buffers.push_back({b.index, {}, kind_of_buffer(b.type), b.interpolate});
  int number = kFirstNamedBuffer;
  for (const scene::FrameBuffer& b : camera.frame_buffers)
    buffers.push_back({number++, b.name, kind_of_buffer(b.datatype), b.filtering.value_or(true)});
  return buffers;
}

/// Whether any shader can write buffers: only shaders of libraries do.
bool has_buffer_writers(const World& world) {
  return std::any_of(world.nodes.begin(), world.nodes.end(),
                     [](const auto& node) { return node->spec().binding.deferred; });
}

}  // namespace

std::unique_ptr<World> prepare(scene::Scene& scene, const scene::RenderCommand& command,
                               const Registry& registry, const PrepareOptions& options,
                               Diagnostics& diagnostics, PrepareReport& report) {
  auto world = std::make_unique<World>();
  world->coarse_tables = options.coarse_tables;
  world->budgets = scene.budgets;
  world->sample_light = sample_light;
  if (const auto* block = scene.get<scene::Options>(command.options))
    world->options = scene::interpret_options(*block, diagnostics);
  else
    diagnostics.warning(
        "OR-RN-002", command.where,
        fmt::format("there are no options \"{}\"; defaults are used", command.options));

  world->shutter = scene::shutter_of(world->options.motion);
  if (world->options.geometry) make_geometry(scene, world->options, registry, diagnostics);
  const std::vector<scene::Leaf> leaves =
      scene::flatten(scene, command.root, diagnostics, {.leaves = scene.budgets[Budget::Instances]},
                     scene::photon_flags(world->options.caustic.object_flags,
                                         world->options.globillum.object_flags));
  const scene::Camera* camera = nullptr;
  const std::string& camera_name = options.camera.empty() ? command.camera : options.camera;
  if (!place_camera(scene, leaves, camera_name, options, *world, camera, diagnostics))
    return nullptr;

  world->user_buffers = user_buffers(world->options, *camera);
  const TexturesAhead textures(scene, used_textures(scene, *camera, leaves), world->texture_system,
                               world->options.gamma);
  world->light_names = place_lights(leaves, *world, diagnostics);
  Binder binder(scene, registry, *world, world->light_names, diagnostics);
  bind_lights(leaves, binder, *world, diagnostics);
  // The environment is bound before the materials; it does not depend on them.
  world->environment = binder.bind(camera->environment);
  // Reports look at a few directions of the environment only.
  if (!options.coarse_tables)
    for (const auto& texture : world->textures) texture->keep_pixels();
  EnvironmentLight environment(*world);
  if (const auto* block = scene.get<scene::Options>(command.options))
    bind_state_shaders(*block, binder, *world, diagnostics);
  if (world->options.lens) bind_lens(*camera, binder, *world, diagnostics);
  if (world->options.volume) bind_volume(*camera, binder, *world, diagnostics);
  place_geometry(scene, leaves, world->light_names, command.options, binder, options, *world,
                 diagnostics, report);
  if (!has_buffer_writers(*world)) world->user_buffers.clear();
  open_portals(*world, environment.table().detailed());
  const std::vector<EmissionKind> emissive = emissive_materials(*world);
  Openings openings;
  if (!options.coarse_tables) openings = find_openings(*world, environment);
  world->light_sampler = std::make_shared<const LightSampler>(
      *world, std::move(environment), mesh_lights_of(*world, emissive), std::move(openings));
  std::vector<scene::LightGroup> groups = options.light_groups;
  for (const scene::LightGroup& g : world->options.light_groups)
    if (std::none_of(groups.begin(), groups.end(), [&](auto& o) { return o.name == g.name; }))
      groups.push_back(g);
  if (!groups.empty()) {
    const std::vector<EmissionKind> emits = emissive_instances(*world, emissive);
    world->light_layers = resolve_light_layers(leaves, groups, *world, emits, diagnostics);
  }

  report.binding = binder.report();
  report.lights = world->lights.size();
  report.instances = world->instances.size();
  return world;
}

}  // namespace oriel
