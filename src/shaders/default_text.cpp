// SPDX-License-Identifier: Apache-2.0
#include "shaders/default_text.h"

#include <fmt/format.h>

namespace oriel {

std::string default_text(const ParamSpec& param) {
  const auto& v = param.fallback;
  switch (param.type) {
    case ParamType::Boolean:
      return v[0] != 0 ? "on" : "off";
    case ParamType::Integer:
    case ParamType::Scalar:
      return fmt::format("{}", v[0]);
    case ParamType::Color:
    case ParamType::Vector:
      return fmt::format("{} {} {}", v[0], v[1], v[2]);
    default:
      return "";
  }
}

}  // namespace oriel
