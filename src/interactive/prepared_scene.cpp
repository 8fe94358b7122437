// SPDX-License-Identifier: Apache-2.0
#include "interactive/prepared_scene.h"

#include <algorithm>

#include "base/input_files.h"
#include "interactive/light_grouping.h"
#include "output/camera_output.h"
#include "sdk/host.h"

namespace oriel::interactive {
namespace {

/// Whether rays of both cameras are the same.
bool same_rays(const Camera& a, const Camera& b) {
  return a.to_world == b.to_world && a.path == b.path && a.focal == b.focal &&
         a.aperture == b.aperture && a.aspect == b.aspect && a.offset == b.offset &&
         a.orthographic == b.orthographic && a.width == b.width && a.height == b.height;
}

}  // namespace

PreparedScene::PreparedScene(SceneSource source, Diagnostics& diagnostics)
    : source_(std::move(source)), diagnostics_(diagnostics) {}

const Registry& PreparedScene::registry() const {
  return host_ ? host_->registry() : *source_.registry;
}

PreparedScene::~PreparedScene() { close_world(); }

void PreparedScene::close_world() {
  if (world_) cache_.keep(*world_);
  if (host_) host_->end_frame();
  outputs_.clear();
  world_.reset();
  host_.reset();
}

bool PreparedScene::read() {
  close_world();
  cache_ = {};
  constexpr std::size_t kLargeMesh = 1 << 15;  // triangles, which take about 10 ms to build
  cache_.least_apart = kLargeMesh;
  edited_.reset();
  diagnostics_.forget_after(0);
  scene_ = std::make_unique<scene::Scene>();
  mi::Reader reader(source_.path, source_.read, diagnostics_);
  if (!reader.opened()) return false;
  for (int i = 0; i < std::max(source_.frame, 1); ++i)
    if (!reader.next_frame(*scene_)) return false;
  if (source_.after_reading) source_.folders = source_.after_reading(*scene_);
  edited_.emplace(*scene_, *source_.registry);
  reading_diagnostics_ = diagnostics_.all().size();
  return true;
}

PrepareOptions PreparedScene::prepare_options(const ViewSettings& view, int width,
                                              int height) const {
  PrepareOptions options;
  options.width = width;
  options.height = height;
  options.camera = view.camera;
  options.light_groups = light_groups(view);
  return options;
}

std::vector<scene::LightGroup> PreparedScene::light_groups(const ViewSettings& view) const {
  if (view.group_lights && view.light_groups.empty()) return group_lights(*scene_, command());
  return view.light_groups;
}

/// Whether shaders and textures that were bound again have grown beyond the limit.
bool PreparedScene::is_crowded() const {
  constexpr std::size_t kSpareNodes = 2000;
  constexpr std::size_t kSpareTextures = 20;
  return world_->nodes.size() > 2 * nodes_at_first_ + kSpareNodes ||
         world_->textures.size() > 2 * textures_at_first_ + kSpareTextures;
}

bool PreparedScene::prepare_all(const ViewSettings& view, int width, int height) {
  ++preparations_;
  close_world();
  forget_frame_inputs();
  diagnostics_.forget_after(reading_diagnostics_);
  host_ = std::make_unique<sdk::Host>(*scene_, *source_.registry, source_.folders, diagnostics_);
  PrepareOptions options = prepare_options(view, width, height);
  options.cache = &cache_;
  PrepareReport report;
  world_ = prepare(*scene_, command(), host_->registry(), options, diagnostics_, report);
  if (!world_) return false;
  nodes_at_first_ = world_->nodes.size();
  textures_at_first_ = world_->textures.size();
  searched_camera_ = world_->camera;
  if (source_.indirect) world_->options.indirect = *source_.indirect;
  if (const scene::Camera* camera = find_camera(*scene_, command(), view.camera))
    outputs_ = camera_output_shaders(*camera, *scene_, host_->registry(), *world_, diagnostics_);
  find_unit();
  return true;
}

void PreparedScene::find_unit() {
  Diagnostics reported;  // contradictions matter to photometric files alone
  unit_ = source_.unit_luminance ? UnitLuminance{*source_.unit_luminance, "--unit-luminance"}
                                 : unit_luminance(*world_, outputs_, reported);
}

bool PreparedScene::prepare_dependents(const std::set<std::string>& elements,
                                       const ViewSettings& view, int width, int height) {
  if (is_crowded()) return false;
  PrepareOptions options = prepare_options(view, width, height);
  options.cache = &cache_;
  if (!update_world(*scene_, command(), host_->registry(), options, elements, *world_))
    return false;
  find_unit();
  return true;
}

void PreparedScene::apply_look(const ViewSettings& view) {
  if (!view.look) return;
  const std::optional<Mat4> to_camera = camera_matrix(*view.look);
  if (!to_camera) return;
  world_->camera.to_camera = *to_camera;
  world_->camera.to_world = to_camera->inverse();
  world_->camera.path.clear();
}

bool PreparedScene::place_camera_alone(const ViewSettings& view, int width, int height) {
  if (!place_camera_again(*scene_, command(), prepare_options(view, width, height), *world_,
                          diagnostics_))
    return false;
  // The sampler of the environment depends on what the scene's camera sees.
  if (!world_->environment.empty() && !same_rays(world_->camera, searched_camera_))
    world_->draft_environment = world_->draft_openings = true;
  searched_camera_ = world_->camera;
  return true;
}

bool PreparedScene::update(const EditEffects& effects, const ViewSettings& view, int width,
                           int height) {
  if (!scene_) return false;
  const bool all =
      !world_ || effects.has(kEffectWorld) ||
      (effects.has(kEffectElements) && !prepare_dependents(effects.elements, view, width, height));
  if (all || (effects.has(kEffectCamera) && !place_camera_alone(view, width, height)))
    if (!prepare_all(view, width, height)) return false;
  apply_look(view);
  return true;
}

void PreparedScene::complete() {
  std::swap(world_->camera, searched_camera_);
  complete_light_sampler(*world_);
  std::swap(world_->camera, searched_camera_);
}

void PreparedScene::resize_camera(const ViewSettings& view, int width, int height) {
  place_camera_again(*scene_, command(), prepare_options(view, width, height), *world_,
                     diagnostics_);
  apply_look(view);
}

std::unique_ptr<World> PreparedScene::separate_world(const ViewSettings& view) {
  const World& now = *world_;
  PrepareOptions options = prepare_options(view, now.camera.width, now.camera.height);
  PrepareReport report;
  Diagnostics reported;
  auto world = prepare(*scene_, command(), host_->registry(), options, reported, report);
  if (!world) return nullptr;
  world->options.indirect = now.options.indirect;
  world->camera = now.camera;
  return world;
}

}  // namespace oriel::interactive
