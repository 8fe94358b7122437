// SPDX-License-Identifier: Apache-2.0
#include "interactive/edit_effects.h"

#include <algorithm>
#include <array>

namespace oriel::interactive {
namespace {

/// Statements of cameras that only place_camera() reads.
constexpr std::array<std::string_view, 6> kCameraStatements = {"focal",      "aperture", "aspect",
                                                               "resolution", "offset",   "clip"};

bool is_camera_instance(const scene::Scene& scene, const std::string& name) {
  const auto* instance = scene.get<scene::Instance>(name);
  return instance && scene.get<scene::Camera>(instance->element);
}

}  // namespace

EditEffects effects_of(const scene::Scene& scene, const std::string& changed,
                       const SceneEdit& edit) {
  if (is_camera_instance(scene, changed) && edit.parameter == "transform")
    return {kEffectCamera, {}};
  if (scene.get<scene::Camera>(changed) &&
      std::find(kCameraStatements.begin(), kCameraStatements.end(), edit.parameter) !=
          kCameraStatements.end())
    return {kEffectCamera, {}};
  const bool has_shaders =
      scene.get<scene::Material>(changed) || scene.get<scene::ShaderElement>(changed);
  if (has_shaders && !edit.value.starts_with('=')) return {kEffectMaterials, {changed}};
  return {kEffectWorld, {}};
}

}  // namespace oriel::interactive
