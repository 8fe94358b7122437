// SPDX-License-Identifier: Apache-2.0
// Elements of a scene as JSON: names, parameters with their declarations and values.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/shader_spec.h"
#include "scene/scene.h"

namespace oriel::studio {

/// Names of all elements, see docs/dev/studio-protocol.md.
nlohmann::json outline_json(const scene::Scene& scene);

/// An element with the parameters of its shaders and its statements; null if there is none.
/// Inputs:  edits: those of the scene, to mark what they set.
/// Checked: StudioSessionTest.*
nlohmann::json element_json(const scene::Scene& scene, const Diagnostics& files,
                            const std::string& name, const Registry& registry,
                            const std::vector<std::string>& edits);

/// A built-in shader; null if there is none.
nlohmann::json shader_json(const Registry& registry, const std::string& name);

}  // namespace oriel::studio
