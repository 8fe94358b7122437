// SPDX-License-Identifier: Apache-2.0
// Edits that take other edits back, after these were written into the scene's files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/shader_spec.h"
#include "scene/scene.h"

namespace oriel::interactive {

/// The edits that give the parameters of `edits` the values that the scene has without them.
///
/// Inputs:  scene: without the edits.
/// Returns: a parameter without a value gets its declared default. Unset if a value has no text as
///          an edit, such as a statement that the scene does not have.
/// Checked: StudioPageTest.SavingCanBeUndone
std::optional<std::vector<std::string>> inverse_edits(scene::Scene& scene,
                                                      const std::vector<std::string>& edits,
                                                      const Registry& registry);

}  // namespace oriel::interactive
