// SPDX-License-Identifier: Apache-2.0
#include "interactive/edited_scene.h"

#include <algorithm>
#include <set>

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

/// Edits of `a` that are not in `b`. The order matters only between edits of the same parameter of
/// the same element: with such edits, all from the first difference on.
EditEffects EditedScene::effects_of_difference(const AppliedEdits& a, const AppliedEdits& b) const {
  const auto repeats_parameters = [&](const AppliedEdits& list) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list.edits.size(); ++i) {
      const std::string parameter = parse_edit(scene_, list.edits[i]).parameter;
      if (!seen.insert(list.targets[i] + "." + parameter).second) return true;
    }
    return false;
  };
  const bool ordered = repeats_parameters(a) || repeats_parameters(b);
  const std::set<std::string> known(b.edits.begin(), b.edits.end());
  const auto first =
      std::mismatch(a.edits.begin(), a.edits.end(), b.edits.begin(), b.edits.end()).first;
  EditEffects effects;
  for (std::size_t i = 0; i < a.edits.size(); ++i) {
    const bool differs = ordered ? i >= static_cast<std::size_t>(first - a.edits.begin())
                                 : !known.contains(a.edits[i]);
    if (differs) effects |= effects_of(scene_, a.targets[i], parse_edit(scene_, a.edits[i]));
  }
  return effects;
}

EditEffects EditedScene::set(const std::vector<std::string>& edits) {
  const AppliedEdits old = now_;
  restore();
  try {
    now_ = {edits, apply(edits)};
  } catch (const EditError&) {
    restore();
    now_ = {old.edits, apply(old.edits)};
    throw;
  }
  EditEffects effects = effects_of_difference(old, now_);
  return effects |= effects_of_difference(now_, old);
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
