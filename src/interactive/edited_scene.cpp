// SPDX-License-Identifier: Apache-2.0
#include "interactive/edited_scene.h"

#include <algorithm>

namespace oriel::interactive {

void EditedScene::restore() {
  for (const auto& original : originals_) {
    *scene_.find(original.first) = original.second;
    scene_.touch(original.first);
  }
  originals_.clear();
}

std::vector<std::string> EditedScene::apply(const std::vector<std::string>& edits) {
  const auto keep = [this](const scene::Element& element) {
    originals_.try_emplace(scene::name_of(element), element);
  };
  std::vector<std::string> targets;
  for (const std::string& edit : edits) {
    targets.push_back(apply_edit(scene_, edit, registry_, keep));
    scene_.touch(targets.back());
  }
  return targets;
}

EditEffects EditedScene::set(const std::vector<std::string>& edits) {
  const std::vector<std::string> old_edits = edits_, old_targets = targets_;
  restore();
  try {
    targets_ = apply(edits);
  } catch (const EditError&) {
    restore();
    targets_ = apply(old_edits);
    throw;
  }
  edits_ = edits;
  const auto [old_at, new_at] =
      std::mismatch(old_edits.begin(), old_edits.end(), edits_.begin(), edits_.end());
  EditEffects effects;
  const auto add = [&](const std::vector<std::string>& list,
                       const std::vector<std::string>& targets, std::size_t from) {
    for (std::size_t i = from; i < list.size(); ++i)
      effects |= effects_of(scene_, targets[i], parse_edit(scene_, list[i]));
  };
  const auto from = static_cast<std::size_t>(new_at - edits_.begin());
  add(old_edits, old_targets, static_cast<std::size_t>(old_at - old_edits.begin()));
  add(edits_, targets_, from);
  return effects;
}

std::vector<std::string> EditedScene::changed() const {
  std::vector<std::string> names;
  for (const auto& original : originals_) names.push_back(original.first);
  return names;
}

std::vector<std::string> with_edit(const scene::Scene& scene, std::vector<std::string> edits,
                                   const std::string& edit) {
  const std::string target = parse_edit(scene, edit).target();
  std::erase_if(
      edits, [&](const std::string& other) { return parse_edit(scene, other).target() == target; });
  edits.push_back(edit);
  return edits;
}

}  // namespace oriel::interactive
