// SPDX-License-Identifier: Apache-2.0
#include "check_thumbnail.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "render/camera_output.h"
#include "render/output.h"
#include "render/prepare.h"
#include "render/session.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "work_folder.h"

namespace oriel::app {
namespace {

constexpr int kWidth = 480;
constexpr std::uint32_t kSamples = 64;
constexpr double kSeconds = 15;

PrepareOptions small(const scene::Camera& camera) {
  PrepareOptions options;
  const auto size = camera.resolution.value_or(std::array{640, 480});
  if (size[0] < 1 || size[1] < 1) return options;
  options.width = std::min(kWidth, size[0]);
  options.height =
      std::clamp(static_cast<int>(std::int64_t{options.width} * size[1] / size[0]), 1, 2 * kWidth);
  return options;
}

std::string rendered(scene::Scene& scene, const sdk::TrustedFolders& trusted, std::string& why) {
  Diagnostics unheard;
  const scene::RenderCommand command = scene.renders.back();
  const scene::Camera* camera = find_camera(scene, command);
  sdk::Host host(scene, builtin_shaders(), trusted, unheard);
  PrepareReport report;
  const auto world =
      camera ? prepare(scene, command, host.registry(), small(*camera), unheard, report) : nullptr;
  if (!world) {
    why = "the scene has no camera that could render it";
    return {};
  }
  world->options.indirect = scene::IndirectMethod::Path;
  const WorkFolder folder;
  PictureFile file = picture_file(folder.file("scene.png"));
  file.shaders = camera_output_shaders(*camera, scene, host.registry(), *world, unheard);
  RenderSession session(*world, {.budget = {.samples = kSamples, .seconds = kSeconds}});
  session.run();
  write_picture(file, session, {});
  host.end_frame();
  std::ifstream picture(file.path, std::ios::binary);
  return {std::istreambuf_iterator<char>(picture), {}};
}

}  // namespace

std::string thumbnail(scene::Scene& scene, const sdk::TrustedFolders& trusted, std::string& why) {
  if (scene.renders.empty()) {
    why = "the scene has no render statement";
    return {};
  }
  try {
    return rendered(scene, trusted, why);
  } catch (const std::exception& e) {
    why = e.what();
    return {};
  }
}

}  // namespace oriel::app
