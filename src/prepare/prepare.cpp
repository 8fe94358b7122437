// SPDX-License-Identifier: Apache-2.0
#include "prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>

#include "lights/sample_light.h"
#include "prepare/generated_geometry.h"
#include "prepare/prepare_parts.h"
#include "prepare/textures_ahead.h"
#include "scene/render_options.h"

namespace oriel {
namespace {

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

/// Records which parts of a world reported messages.
class PartMessages {
 public:
  PartMessages(World& world, const Diagnostics& diagnostics)
      : world_(world), diagnostics_(diagnostics), before_(diagnostics.all().size()) {}
  /// Inputs:  part: the one that was prepared since the last call.
  void end(PreparedPart part) {
    if (diagnostics_.all().size() != before_) world_.parts_with_messages |= part;
    skip();
  }
  void skip() { before_ = diagnostics_.all().size(); }

 private:
  World& world_;
  const Diagnostics& diagnostics_;
  std::size_t before_;
};

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
  PartMessages messages(*world, diagnostics);
  world->light_names = place_lights(leaves, *world, diagnostics);
  Binder binder(scene, registry, *world, world->light_names, diagnostics);
  bind_lights(leaves, binder, *world, diagnostics);
  messages.end(kPartLights);
  bind_environment(*camera, binder, *world);
  EnvironmentLight environment(*world);
  messages.end(kPartEnvironment);
  bind_camera_shaders(scene.get<scene::Options>(command.options), *camera, binder, *world,
                      diagnostics);
  messages.end(kPartCameraShaders);
  place_geometry(scene, leaves, world->light_names, command.options, binder, options, *world,
                 diagnostics, report);
  messages.skip();
  if (!has_buffer_writers(*world)) world->user_buffers.clear();
  const auto emissive = make_light_sampler(std::move(environment), {}, *world);
  make_light_layers(leaves, options, emissive, *world, diagnostics);
  messages.end(kPartSampler);

  report.binding = binder.report();
  report.lights = world->lights.size();
  report.instances = world->instances.size();
  return world;
}

}  // namespace oriel
