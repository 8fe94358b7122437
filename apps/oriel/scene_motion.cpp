// SPDX-License-Identifier: Apache-2.0
#include "scene_motion.h"

#include "base/diagnostic.h"
#include "scene/hierarchy.h"
#include "scene/scene.h"

namespace oriel::app {

void SceneMotion::add_frame(const scene::Scene& scene) {
  if (scene.renders.empty()) return;
  Diagnostics reported;  // rendering reports them
  std::map<std::string, std::size_t> counts;
  for (const scene::Leaf& leaf : scene::flatten(scene, scene.renders.back().root, reported)) {
    const std::string& name = leaf.instance().name;
    std::vector<Change>& changes = changes_[{name, counts[name]++}];
    if (changes.empty() || changes.back().matrix != leaf.local_to_world)
      changes.push_back({frames_, leaf.local_to_world});
  }
  ++frames_;
}

std::vector<Mat4> SceneMotion::matrices(const std::string& instance, std::size_t nth) const {
  const auto found = changes_.find({instance, nth});
  if (found == changes_.end() || found->second.size() < 2) return {};
  const std::vector<Change>& changes = found->second;
  std::vector<Mat4> all;
  all.reserve(frames_);
  std::size_t at = 0;
  for (std::size_t frame = 0; frame < frames_; ++frame) {
    while (at + 1 < changes.size() && changes[at + 1].frame <= frame) ++at;
    all.push_back(changes[at].matrix);
  }
  return all;
}

}  // namespace oriel::app
