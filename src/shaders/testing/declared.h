// SPDX-License-Identifier: Apache-2.0
// Test support: declared interfaces as text.
#pragma once

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "runtime/shader_spec.h"
#include "shaders/registry.h"

namespace oriel {

inline const ShaderSpec& spec_of(std::string_view name) {
  const ShaderSpec* spec = builtin_shaders().find(name);
  if (!spec) throw std::runtime_error(fmt::format("no shader {}", name));
  return *spec;
}

inline std::string default_of(const ParamSpec& p) {
  if (!p.declared_default) return "-";
  const auto& v = p.fallback;
  switch (p.type) {
    case ParamType::Boolean:
      return v[0] != 0 ? "on" : "off";
    case ParamType::Integer:
    case ParamType::Scalar:
      return fmt::format("{:g}", v[0]);
    case ParamType::Color:
    case ParamType::Vector:
      return fmt::format("{:g} {:g} {:g}", v[0], v[1], v[2]);
    default:
      return "-";
  }
}

inline std::string table_of(std::string_view shader) {
  std::string text = "\n";
  for (const ParamSpec& p : spec_of(shader).params)
    text += fmt::format("{} | {} | {}\n", p.name, type_text(p), default_of(p));
  return text;
}

}  // namespace oriel
