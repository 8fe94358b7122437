// SPDX-License-Identifier: Apache-2.0
#include "quick_look.h"

#include <algorithm>

#include "output/camera_output.h"
#include "prepare/prepare.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

PrepareOptions small(const scene::Camera& camera, int width) {
  PrepareOptions options;
  const auto size = camera.resolution.value_or(std::array{640, 480});
  if (size[0] < 1 || size[1] < 1) return options;
  options.width = std::min(width, size[0]);
  options.height =
      std::clamp(static_cast<int>(std::int64_t{options.width} * size[1] / size[0]), 1, 2 * width);
  return options;
}

}  // namespace

bool quick_look(scene::Scene& scene, const sdk::TrustedFolders& trusted, const QuickLook& look,
                const std::function<void(const QuickLookResult&)>& use) {
  if (scene.renders.empty()) return false;
  Diagnostics unheard;
  const scene::RenderCommand command = scene.renders.back();
  const scene::Camera* camera = find_camera(scene, command);
  if (!camera) return false;
  sdk::Host host(scene, builtin_shaders(), trusted, unheard);
  PrepareReport report;
  const auto world =
      prepare(scene, command, host.registry(), small(*camera, look.width), unheard, report);
  if (!world) return false;
  world->options.choose_paths_alone();
  RenderSession session(*world, {.budget = {.samples = look.samples, .seconds = look.seconds}});
  session.run();
  use({session, *world, *camera, host});
  host.end_frame();
  return true;
}

}  // namespace oriel::app
