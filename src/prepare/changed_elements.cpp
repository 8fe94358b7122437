// SPDX-License-Identifier: Apache-2.0
#include "prepare/changed_elements.h"

#include <algorithm>

namespace oriel {
namespace {

/// References of phenomena, of shaders that make geometry, of options and of outputs. All elements
/// count, used or not.
void follow_unsupported(const scene::Scene& scene, scene::References& references) {
  for (const scene::Element& element : scene.elements()) {
    if (const auto* options = std::get_if<scene::Options>(&element)) {
      references.follow(options->state);
    } else if (const auto* camera = std::get_if<scene::Camera>(&element)) {
      for (const scene::Output& output : camera->outputs) references.follow(output.shaders);
    } else if (const auto* instance = std::get_if<scene::Instance>(&element)) {
      references.follow(instance->geometry);
      references.follow(instance->transform_shaders);
    }
  }
  for (const scene::Phenomenon& phenomenon : scene.phenomena) {
    for (const scene::ShaderElement& shader : phenomenon.shaders)
      references.follow(shader.functions);
    for (const scene::Material& material : phenomenon.materials) {
      references.follow(material.shaders);
      for (const scene::Material::Slot& slot : material.slots) references.follow(slot.shaders);
    }
    for (const scene::Light& light : phenomenon.lights) references.follow(light.shaders);
    for (const scene::Phenomenon::Root& root : phenomenon.roots) {
      references.follow(root.name);
      references.follow(root.shaders);
    }
  }
}

bool is_supported_kind(const scene::Scene& scene, const std::string& name) {
  if (const auto* instance = scene.get<scene::Instance>(name)) return instance->geometry.empty();
  return scene.get<scene::Camera>(name) || scene.get<scene::Material>(name) ||
         scene.get<scene::ShaderElement>(name) || scene.get<scene::Light>(name) ||
         scene.get<scene::Texture>(name);
}

}  // namespace

bool ChangedElements::are_supported() const {
  if (!std::all_of(names_.begin(), names_.end(),
                   [&](const std::string& name) { return is_supported_kind(scene_, name); }))
    return false;
  scene::References references(scene_);
  follow_unsupported(scene_, references);
  return !affect(references);
}

bool ChangedElements::affect(const scene::References& references) const {
  return std::any_of(names_.begin(), names_.end(),
                     [&](const std::string& name) { return references.contains(name); });
}

bool ChangedElements::affect(const scene::ShaderList& list) const {
  scene::References references(scene_);
  references.follow(list);
  return affect(references);
}

bool ChangedElements::affect(const scene::Light& light) const {
  return contain(light.name) || affect(light.shaders) || affect(light.emitters);
}

bool ChangedElements::affect(const std::string& element) const {
  scene::References references(scene_);
  references.follow(element);
  return affect(references);
}

bool ChangedElements::place(const scene::Leaf& leaf) const {
  return std::any_of(leaf.chain.begin(), leaf.chain.end(),
                     [&](const scene::Instance* instance) { return contain(instance->name); });
}

void ChangedElements::add_light(const scene::Leaf& leaf) {
  names_.insert(leaf.light()->name);
  for (const scene::Instance* instance : leaf.chain) {
    names_.insert(instance->name);
    if (instance != leaf.chain.back()) names_.insert(instance->element);
  }
}

}  // namespace oriel
