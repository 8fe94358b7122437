// SPDX-License-Identifier: Apache-2.0
// The call of a shader that a use names.
#pragma once

#include "scene/scene.h"

namespace oriel::models::gltf {

/// The call behind a name or itself; null: none.
inline const scene::ShaderUse* call_of(const scene::Scene& scene, const scene::ShaderUse& use) {
  if (use.reference.empty()) return &use;
  const auto* element = scene.get<scene::ShaderElement>(use.reference);
  return element && !element->functions.empty() ? &element->functions.back() : nullptr;
}

}  // namespace oriel::models::gltf
