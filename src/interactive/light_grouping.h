// SPDX-License-Identifier: Apache-2.0
// Light groups for scenes that define none: one for each light.
#pragma once

#include <vector>

#include "scene/light_group.h"
#include "scene/scene.h"

namespace oriel::interactive {

/// One group for each light instance below the root, at most kMaxGroupedLights, and one for the
/// environment. Empty if the scene's options define groups.
/// Checked: StudioSessionTest.LightLayersSumToTheBeauty
std::vector<scene::LightGroup> group_lights(const scene::Scene& scene,
                                            const scene::RenderCommand& command);

inline constexpr std::size_t kMaxGroupedLights = 12;

}  // namespace oriel::interactive
