// SPDX-License-Identifier: Apache-2.0
#include "interactive/edit_effects.h"

#include <algorithm>
#include <array>
#include <vector>

#include "interactive/element_statements.h"

namespace oriel::interactive {
namespace {

/// Statements of cameras that only place_camera() reads.
constexpr std::array<std::string_view, 6> kCameraStatements = {"focal",      "aperture", "aspect",
                                                               "resolution", "offset",   "clip"};

/// See unit_luminance().
constexpr std::string_view kUnitParameter = "rgb_unit_conversion";

bool is_camera_instance(const scene::Scene& scene, const std::string& name) {
  const auto* instance = scene.get<scene::Instance>(name);
  return instance && scene.get<scene::Camera>(instance->element);
}

bool is_statement(const scene::Element& element, const std::string& name) {
  const std::vector<StatementValue> statements = statements_of(element);
  return std::any_of(statements.begin(), statements.end(),
                     [&](const StatementValue& statement) { return statement.name == name; });
}

}  // namespace

EditEffects effects_of(const scene::Scene& scene, const std::string& changed,
                       const SceneEdit& edit) {
  if (is_camera_instance(scene, changed) && edit.parameter == "transform")
    return {kEffectCamera, {}};
  if (scene.get<scene::Camera>(changed)) {
    if (std::find(kCameraStatements.begin(), kCameraStatements.end(), edit.parameter) !=
        kCameraStatements.end())
      return {kEffectCamera, {}};
    if (is_statement(*scene.find(changed), edit.parameter)) return {kEffectWorld, {}};
  }
  const bool has_dependents =
      scene.get<scene::Camera>(changed) || scene.get<scene::Material>(changed) ||
      scene.get<scene::ShaderElement>(changed) || scene.get<scene::Light>(changed) ||
      scene.get<scene::Instance>(changed) || scene.get<scene::Texture>(changed);
  if (has_dependents && edit.parameter != kUnitParameter) return {kEffectElements, {changed}};
  return {kEffectWorld, {}};
}

}  // namespace oriel::interactive
