// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "prepare/prepare.h"
#include "prepare/prepare_parts.h"
#include "prepare/tessellation_plan.h"

namespace oriel {

bool place_camera_again(const scene::Scene& scene, const scene::RenderCommand& command,
                        const PrepareOptions& options, World& world, Diagnostics& diagnostics) {
  Diagnostics known;  // reported when the world was prepared
  const std::vector<scene::Leaf> leaves =
      scene::flatten(scene, command.root, known, {.leaves = scene.budgets[Budget::Instances]},
                     scene::photon_flags(world.options.caustic.object_flags,
                                         world.options.globillum.object_flags));
  const auto* block = scene.get<scene::Options>(command.options);
  const Camera before = world.camera;
  const std::string& name = options.camera.empty() ? command.camera : options.camera;
  const scene::Camera* element = nullptr;
  world.camera = {};
  if (!place_camera(scene, leaves, name, options, world, element, diagnostics)) {
    world.camera = before;
    return false;
  }
  const TessellationPlan plan = plan_tessellation(leaves, block, world.camera);
  return std::none_of(plan.jobs.begin(), plan.jobs.end(),
                      [](const TessellationJob& job) { return job.approximated; });
}

}  // namespace oriel
