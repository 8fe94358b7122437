// SPDX-License-Identifier: Apache-2.0
#include "scene_motion.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/diagnostic.h"
#include "scene/hierarchy.h"
#include "scene/scene.h"
#include "scene_json.h"

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
  add_elements(scene);
  cameras_.push_back(scene.renders.back().camera);
  ++frames_;
}

void SceneMotion::add_elements(const scene::Scene& scene) {
  for (const scene::Element& element : scene.elements()) {
    const std::string list = element_list(element);
    if (list.empty() || truncated()) continue;
    std::string text =
        element_json(element).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::vector<Version>& versions = versions_[{list, scene::name_of(element)}];
    if (!versions.empty() && versions.back().json == text) continue;
    versions_bytes_ += text.size();
    versions.push_back({frames_, std::move(text)});
  }
}

std::vector<SceneMotion::Version> SceneMotion::versions(const std::string& list,
                                                        const std::string& element) const {
  const auto found = versions_.find({list, element});
  if (found == versions_.end() || found->second.size() < 2) return {};
  return found->second;
}

std::vector<std::string> SceneMotion::cameras() const {
  const bool equal = std::all_of(cameras_.begin(), cameras_.end(),
                                 [&](const std::string& name) { return name == cameras_[0]; });
  return equal ? std::vector<std::string>() : cameras_;
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
