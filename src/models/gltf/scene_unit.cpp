// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/scene_unit.h"

#include <string_view>
#include <vector>

#include "base/math.h"
#include "base/vec.h"
#include "models/gltf/shader_call.h"
#include "scene/scene.h"

namespace oriel::models::gltf {
namespace {

/// The numbers of an argument; empty without it.
std::vector<double> numbers_of(const scene::ShaderUse& use, std::string_view name) {
  for (const scene::Argument& argument : use.arguments)
    if (argument.name == name) return argument.value.numbers;
  return {};
}

float by_exposure(const scene::Scene& scene, const scene::Camera& camera) {
  for (const scene::ShaderUse& use : camera.lens) {
    const scene::ShaderUse* call = call_of(scene, use);
    if (!call || call->type != "mia_exposure_photographic") continue;
    const std::vector<double> factor = numbers_of(*call, "cm2_factor");
    return factor.empty() ? 1 : static_cast<float>(factor[0]);
  }
  return 0;
}

float by_conversion(const scene::ShaderList& list) {
  for (const scene::ShaderUse& use : list) {
    const std::vector<double> unit = numbers_of(use, "rgb_unit_conversion");
    if (unit.size() < 3) continue;
    const double mean = (unit[0] + unit[1] + unit[2]) / 3;
    if (mean > 0) return static_cast<float>(kInvPi / mean);
  }
  return 0;
}

}  // namespace

float unit_of(const scene::Scene& scene) {
  float by_sky = 0;
  for (const scene::Element& element : scene.elements()) {
    float found = 0;
    if (const auto* camera = std::get_if<scene::Camera>(&element)) {
      if (const float unit = by_exposure(scene, *camera); unit > 0) return unit;
      found = by_conversion(camera->environment);
    }
    if (const auto* shader = std::get_if<scene::ShaderElement>(&element))
      found = by_conversion(shader->functions);
    if (const auto* light = std::get_if<scene::Light>(&element))
      found = by_conversion(light->shaders);
    if (by_sky <= 0) by_sky = found;
  }
  return by_sky > 0 ? by_sky : 1;
}

}  // namespace oriel::models::gltf
