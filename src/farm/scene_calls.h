// SPDX-License-Identifier: Apache-2.0
// Visits every shader call of a scene.
#pragma once

#include <functional>

#include "scene/scene.h"

namespace oriel::farm {

/// Calls `visit` for all shader calls and references of elements and phenomena.
void each_call(const scene::Scene& scene,
               const std::function<void(const scene::ShaderUse&)>& visit);

}  // namespace oriel::farm
