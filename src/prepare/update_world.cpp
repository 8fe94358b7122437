// SPDX-License-Identifier: Apache-2.0
// Prepares again what depends on changed elements of a prepared world.
#include <algorithm>
#include <utility>

#include "lights/emission.h"
#include "lights/light_sampler.h"
#include "prepare/changed_elements.h"
#include "prepare/prepare_parts.h"

namespace oriel {
namespace {

/// One call of update_world().
class WorldUpdate {
 public:
  WorldUpdate(scene::Scene& scene, const scene::RenderCommand& command, const Registry& registry,
              const PrepareOptions& options, const std::set<std::string>& changed, World& world)
      : scene_(scene),
        command_(command),
        options_(options),
        changed_(scene, changed),
        world_(world),
        binder_(scene, registry, world, world.light_names, reported_) {}

  bool run();

 private:
  bool place_leaves();
  void find_dependents();
  bool renew_lights();
  bool renew_camera_shaders();
  bool renew_materials();
  bool renew_instances();
  void make_draft_sampler();
  bool reported_before(unsigned parts) const { return (world_.parts_with_messages & parts) != 0; }

  scene::Scene& scene_;
  const scene::RenderCommand& command_;
  const PrepareOptions& options_;
  ChangedElements changed_;
  World& world_;
  Diagnostics reported_;
  Binder binder_;
  std::vector<scene::Leaf> leaves_;
  const scene::Camera* camera_ = nullptr;
  // What depends on the change:
  bool lights_ = false, environment_ = false, camera_shaders_ = false, instances_ = false;
  bool materials_ = false;  ///< which surfaces emit or let light pass
  bool portals_ = false;    ///< there are portals now, or were before
  std::shared_ptr<const LightSampler> sampler_before_;
};

bool is_of_users(const std::unique_ptr<ShaderNode>& node) { return node->runs_code_of_users(); }

/// Whether both materials have neither displacement nor volumes.
bool keep_shapes(const Material& a, const Material& b) {
  return a.displace.empty() && b.displace.empty() && a.volume.empty() && b.volume.empty();
}

/// Whether the rest of a world is the same with either material.
bool can_replace(const Material& a, const Material& b) {
  return !may_emit(a) && !may_emit(b) && a.may_transmit == b.may_transmit &&
         a.may_have_holes == b.may_have_holes && a.opaque == b.opaque && a.outputs == b.outputs &&
         a.has_shadow_shader == b.has_shadow_shader;
}

template <class T>
std::vector<std::string> names_in(const std::vector<T>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const T& item : list) names.push_back(item.name);
  return names;
}

/// Whether the list contains shaders, besides names of them.
bool contains_calls(const scene::ShaderList& list) {
  return std::any_of(list.begin(), list.end(),
                     [](const scene::ShaderUse& use) { return use.reference.empty(); });
}

bool has_portals(const World& world) {
  return std::any_of(world.lights.begin(), world.lights.end(),
                     [](const Light& light) { return light.portal != nullptr; });
}

/// Whether the instances use the materials in the order of their indices, as in a new world.
bool has_order_of_new_world(const World& world) {
  std::size_t used = 0;
  for (const InstanceData& instance : world.instances)
    for (const int index : instance.materials) {
      if (static_cast<std::size_t>(index) > used) return false;
      used = std::max(used, static_cast<std::size_t>(index) + 1);
    }
  return used == world.materials.size();
}

bool WorldUpdate::run() {
  if (std::any_of(world_.nodes.begin(), world_.nodes.end(), is_of_users)) return false;
  if (!changed_.are_supported() || !place_leaves()) return false;
  find_dependents();
  sampler_before_ = std::exchange(world_.light_sampler, nullptr);
  // The table of the environment depends on the textures of it and of the lights: they come first.
  std::deque<std::unique_ptr<TextureNode>> textures;
  if (environment_) textures.swap(world_.textures);
  if (lights_ && !renew_lights()) return false;
  if (environment_) {
    bind_environment(*camera_, binder_, world_);
    world_.textures.insert(world_.textures.begin(), std::move_iterator(textures.begin()),
                           std::move_iterator(textures.end()));
  }
  if (camera_shaders_ && !renew_camera_shaders()) return false;
  if (!renew_materials() || (instances_ && !renew_instances())) return false;
  if (!lights_ && !instances_ && !materials_) {
    world_.light_sampler = std::move(sampler_before_);
    return reported_.all().empty();
  }
  if (reported_before(kPartSampler)) return false;
  make_draft_sampler();
  return reported_.all().empty();
}

void WorldUpdate::make_draft_sampler() {
  world_.draft_environment |= environment_;
  world_.draft_openings |= instances_;
  const Openings& openings = sampler_before_->openings();
  KnownOpenings known;
  if (!environment_ && !portals_) known.all = openings;
  known.found = openings.found();
  if (!known.found && world_.draft_openings)
    known.found = std::make_shared<const std::vector<OpeningRectangle>>();
  const auto emissive = make_light_sampler(
      environment_ ? EnvironmentLight(world_, true) : sampler_before_->environment(),
      std::move(known), world_);
  make_light_layers(leaves_, options_, emissive, world_, reported_);
}

bool WorldUpdate::place_leaves() {
  Diagnostics known;  // reported when the world was prepared
  leaves_ =
      scene::flatten(scene_, command_.root, known, {.leaves = scene_.budgets[Budget::Instances]},
                     scene::photon_flags(world_.options.caustic.object_flags,
                                         world_.options.globillum.object_flags));
  world_.camera = {};
  const std::string& name = options_.camera.empty() ? command_.camera : options_.camera;
  if (!place_camera(scene_, leaves_, name, options_, world_, camera_, known)) return false;
  // Openings are searched, and surfaces tessellated, as the camera sees them.
  return std::none_of(leaves_.begin(), leaves_.end(), [&](const scene::Leaf& leaf) {
    return leaf.kind == scene::LeafKind::Camera && leaf.camera() == camera_ && changed_.place(leaf);
  });
}

void WorldUpdate::find_dependents() {
  for (const scene::Leaf& leaf : leaves_) instances_ |= leaf.object() && changed_.place(leaf);
  // Lights may refer to lights.
  for (std::size_t before = SIZE_MAX; changed_.size() != before;) {
    before = changed_.size();
    for (const scene::Leaf& leaf : leaves_) {
      if (leaf.kind != scene::LeafKind::Light) continue;
      if (!changed_.place(leaf) && !changed_.affect(*leaf.light())) continue;
      lights_ = true;
      changed_.add_light(leaf);
    }
  }
  const bool camera = changed_.contain(camera_->name);
  environment_ =
      changed_.affect(camera_->environment) || (camera && contains_calls(camera_->environment));
  camera_shaders_ = camera || changed_.affect(camera_->lens) || changed_.affect(camera_->volume);
  // Lights have the shapes of instances, and portals the environment behind them.
  lights_ |= instances_ || environment_;
}

bool WorldUpdate::renew_lights() {
  if (reported_before(kPartLights) || (environment_ && reported_before(kPartEnvironment)))
    return false;
  const std::vector<std::string> names = names_in(world_.lights);
  portals_ = has_portals(world_);
  world_.lights.clear();
  world_.has_area_lights = false;
  if (place_lights(leaves_, world_, reported_) != world_.light_names ||
      names_in(world_.lights) != names)
    return false;
  bind_lights(leaves_, binder_, world_, reported_);
  portals_ |= has_portals(world_);
  return true;
}

bool WorldUpdate::renew_camera_shaders() {
  // Output shaders may have the preview.
  if (reported_before(kPartCameraShaders) || world_.preview) return false;
  for (NodeList* list : {&world_.lens, &world_.lens_rays, &world_.eye_volume, &world_.camera_volume,
                         &world_.light_volume, &world_.state_shaders})
    list->clear();
  bind_camera_shaders(scene_.get<scene::Options>(command_.options), *camera_, binder_, world_,
                      reported_);
  return true;
}

bool WorldUpdate::renew_materials() {
  for (Material& material : world_.materials) {
    if (!changed_.affect(material.name)) continue;
    if (material.has_messages) return false;
    Material bound = bind_material(scene_, material.name, {}, binder_, reported_);
    if (!keep_shapes(material, bound)) return false;
    if (!can_replace(material, bound)) materials_ = true;
    instances_ |= material.may_transmit != bound.may_transmit;
    material = std::move(bound);
  }
  return true;
}

bool WorldUpdate::renew_instances() {
  const std::vector<std::string> names = names_in(world_.instances);
  world_.instances.clear();
  world_.has_transparent_blockers = world_.has_unseen_blockers = world_.photons_part_ways = false;
  world_.shadowless = 0;
  options_.cache->keep(world_);
  PrepareReport report;
  place_geometry(scene_, leaves_, world_.light_names, command_.options, binder_, options_, world_,
                 reported_, report);
  return names_in(world_.instances) == names && has_order_of_new_world(world_);
}

}  // namespace

bool update_world(scene::Scene& scene, const scene::RenderCommand& command,
                  const Registry& registry, const PrepareOptions& options,
                  const std::set<std::string>& changed, World& world) {
  return WorldUpdate(scene, command, registry, options, changed, world).run();
}

}  // namespace oriel
