// SPDX-License-Identifier: Apache-2.0
// Binds the shaders of the camera and of the options: lens, volume, state.
#include <fmt/format.h>

#include "prepare/prepare_parts.h"
#include "runtime/color_mapping.h"
#include "runtime/fallback_shader.h"

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

}  // namespace

void bind_camera_shaders(const scene::Options* options, const scene::Camera& camera, Binder& binder,
                         World& world, Diagnostics& diagnostics) {
  if (options) bind_state_shaders(*options, binder, world, diagnostics);
  if (world.options.lens) bind_lens(camera, binder, world, diagnostics);
  if (world.options.volume) bind_volume(camera, binder, world, diagnostics);
}

}  // namespace oriel
