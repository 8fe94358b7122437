// SPDX-License-Identifier: Apache-2.0
// A scene with a list of edits, which may change in any way; elements return to what was read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "interactive/edit_effects.h"
#include "interactive/scene_edit.h"
#include "scene/scene.h"

namespace oriel::interactive {

/// A scene whose edits can be replaced.
///
/// Model:   the scene is always what was read with the edits of the list applied in their order, as
///          `--set` does. The first edit of an element stores a copy of it.
/// Checked: EditTable.*
class EditedScene {
 public:
  /// The scene was just read. `registry` has to outlive this.
  EditedScene(scene::Scene& scene, const Registry& registry) : scene_(scene), registry_(registry) {}

  /// Replaces the list.
  ///
  /// Returns: what has to be prepared again.
  /// Errors:  EditError of the first edit that the scene cannot take; the list and the scene are
  ///          then as before.
  EditEffects set(const std::vector<std::string>& edits);

  const std::vector<std::string>& edits() const { return now_.edits; }
  /// Names of the elements that differ from what was read.
  std::vector<std::string> changed() const;

 private:
  struct AppliedEdits {
    std::vector<std::string> edits;
    std::vector<std::string> targets;  ///< changed element of each edit
  };
  EditEffects effects_of_difference(const AppliedEdits& a, const AppliedEdits& b) const;
  void restore();
  /// Element that each edit changed.
  std::vector<std::string> apply(const std::vector<std::string>& edits);

  scene::Scene& scene_;
  const Registry& registry_;
  AppliedEdits now_;
  std::map<std::string, scene::Element> originals_;
};

/// The list with one more edit; an earlier edit of the same parameter is removed.
/// Errors:  EditError, EditFormError.
std::vector<std::string> with_edit(const scene::Scene& scene, std::vector<std::string> edits,
                                   const std::string& edit);

}  // namespace oriel::interactive
