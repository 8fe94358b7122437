// SPDX-License-Identifier: Apache-2.0
#include "scene/references.h"

#include <utility>

namespace oriel::scene {

void References::follow(const std::string& name) {
  note(name);
  follow_noted();
}

void References::follow(const ShaderList& list) {
  note(list);
  follow_noted();
}

// Chains of references may be long, so they are not followed by recursion.
void References::follow_noted() {
  while (!noted_.empty()) {
    const std::string name = std::move(noted_.back());
    noted_.pop_back();
    found_.push_back(name);
    if (const auto* texture = scene_.get<Texture>(name)) {
      note(texture->procedure);
    } else if (const auto* shader = scene_.get<ShaderElement>(name)) {
      note(shader->functions);
    } else if (const auto* material = scene_.get<Material>(name)) {
      note(material->shaders);
      for (const Material::Slot& slot : material->slots) note(slot.shaders);
    }
  }
}

void References::note(const std::string& name) {
  if (!name.empty() && seen_.insert(name).second) noted_.push_back(name);
}

// A dot is part of a name, or begins the name of a result.
void References::note_shader(const std::string& name) {
  std::string element = name;
  while (!scene_.find(element) && element.find('.') != std::string::npos)
    element.resize(element.rfind('.'));
  note(element);
}

void References::note(const ShaderList& list) {
  for (const ShaderUse& use : list) {
    note_shader(use.reference);
    for (const Argument& argument : use.arguments) note(argument.value);
  }
}

void References::note(const Value& value) {
  if (value.kind == Value::Kind::Text) note(value.text);
  if (value.kind == Value::Kind::Connection) note_shader(value.text);
  for (const Value& item : value.items) note(item);
  for (const Argument& member : value.members) note(member.value);
}

}  // namespace oriel::scene
