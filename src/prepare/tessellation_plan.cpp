// SPDX-License-Identifier: Apache-2.0
#include "prepare/tessellation_plan.h"

#include <ImathBox.h>

#include <algorithm>
#include <map>

namespace oriel {
namespace {

using scene::kNone;

scene::TessellationView view_of(const scene::Leaf& leaf, const Camera& camera) {
  scene::TessellationView view;
  view.object_to_camera = leaf.local_to_world * camera.to_camera;
  view.orthographic = camera.orthographic;
  const float film = camera.orthographic ? camera.aperture : camera.aperture / camera.focal;
  if (film > 0) view.pixels_per_unit = static_cast<float>(camera.width) / film;
  return view;
}

/// Whether anything is measured in pixels.
bool is_approximated(const TessellationJob& job) {
  return !job.context.chain.empty() ||
         (job.context.options && scene::has_approximations(job.context.options->statements)) ||
         std::any_of(job.object->groups.begin(), job.object->groups.end(),
                     [](const auto& group) { return scene::has_approximations(group.settings); });
}

Imath::Box3f bounds(const scene::Object& object) {
  Imath::Box3f box;
  for (const scene::PolygonGroup& group : object.groups)
    for (const std::uint32_t point : group.vertices.point)
      if (point < group.vectors.size() && is_finite(group.vectors[point]))
        box.extendBy(group.vectors[point]);
  return box;
}

}  // namespace

TessellationPlan plan_tessellation(const std::vector<scene::Leaf>& leaves,
                                   const scene::Options* options, const Camera& camera) {
  TessellationPlan plan;
  std::map<std::pair<const scene::Object*, std::vector<const scene::Instance*>>, std::uint32_t>
      known;
  struct Finest {
    bool asked = false;
    Imath::Box3f box;
    float pixels = -1;
  };
  std::vector<Finest> finest;
  plan.job_of_leaf.reserve(leaves.size());
  for (const scene::Leaf& leaf : leaves) {
    const scene::Object* object = leaf.object();
    if (!object || leaf.flags.hidden) {
      plan.job_of_leaf.push_back(kNone);
      continue;
    }
    std::vector<const scene::Instance*> chain;
    for (const scene::Instance* instance : leaf.chain)
      if (scene::has_approximations(instance->flags)) chain.push_back(instance);
    const auto [entry, is_new] =
        known.try_emplace({object, std::move(chain)}, static_cast<std::uint32_t>(plan.jobs.size()));
    const std::uint32_t number = entry->second;
    plan.job_of_leaf.push_back(number);
    if (is_new) {
      TessellationJob& job = plan.jobs.emplace_back();
      job = {object, {entry->first.second, options, view_of(leaf, camera)}, false};
      Finest& first = finest.emplace_back();
      first.asked = job.approximated = is_approximated(job);
      if (first.asked) first.box = bounds(*object);
    }
    Finest& best = finest[number];
    if (!best.asked || best.box.isEmpty()) continue;
    const scene::TessellationView view = view_of(leaf, camera);
    const float pixels = view.pixels(best.box.min, best.box.max);
    if (pixels <= best.pixels) continue;
    best.pixels = pixels;
    plan.jobs[number].context.view = view;
  }
  return plan;
}

}  // namespace oriel
