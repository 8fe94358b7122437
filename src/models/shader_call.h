// SPDX-License-Identifier: Apache-2.0
// Builds shader calls for generated scenes.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "base/vec.h"
#include "scene/shader.h"

namespace oriel::models {

inline scene::Value numbers(std::initializer_list<float> list, bool integral = false) {
  scene::Value value;
  value.kind = scene::Value::Kind::Numbers;
  value.integral = integral;
  value.numbers.assign(list.begin(), list.end());
  return value;
}

inline scene::Value text(std::string content, scene::Value::Kind kind = scene::Value::Kind::Text) {
  scene::Value value;
  value.kind = kind;
  value.text = std::move(content);
  return value;
}

/// "type" ( "name" value, ... ), built parameter by parameter.
class ShaderCall {
 public:
  explicit ShaderCall(std::string type) { use_.type = std::move(type); }
  ShaderCall& set(const std::string& name, scene::Value value) {
    use_.arguments.push_back({name, std::move(value), {}});
    return *this;
  }
  ShaderCall& set(const std::string& name, float value) { return set(name, numbers({value})); }
  ShaderCall& set(const std::string& name, int value) {
    return set(name, numbers({static_cast<float>(value)}, true));
  }
  ShaderCall& set(const std::string& name, bool value) {
    scene::Value v;
    v.kind = scene::Value::Kind::Boolean;
    v.boolean = value;
    return set(name, std::move(v));
  }
  ShaderCall& set(const std::string& name, const Vec3& v) {
    return set(name, numbers({v.x, v.y, v.z}));
  }
  ShaderCall& set(const std::string& name, const char* content) { return set(name, text(content)); }
  ShaderCall& connect(const std::string& name, const std::string& shader) {
    return set(name, text(shader, scene::Value::Kind::Connection));
  }
  bool has(std::string_view name) const {
    return std::any_of(use_.arguments.begin(), use_.arguments.end(),
                       [&](const scene::Argument& argument) { return argument.name == name; });
  }
  const scene::ShaderUse& use() const { return use_; }

 private:
  scene::ShaderUse use_;
};

}  // namespace oriel::models
