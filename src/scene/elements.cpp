// SPDX-License-Identifier: Apache-2.0
#include "scene/elements.h"

namespace oriel::scene {

const ShaderList* Material::slot(std::string_view keyword) const {
  for (const Slot& s : slots)
    if (s.keyword == keyword) return &s.shaders;
  return nullptr;
}

bool operator==(const Texture& a, const Texture& b) {
  return a.name == b.name && a.type == b.type && a.local == b.local && a.writable == b.writable &&
         a.filter == b.filter && a.file == b.file && a.format == b.format &&
         a.data_type == b.data_type && a.size == b.size && a.pixels == b.pixels &&
         a.procedure == b.procedure;
}

std::string_view type_name(ParamType type) {
  constexpr std::string_view kNames[] = {
      "boolean",      "integer",   "scalar",        "string",         "color",
      "vector",       "transform", "light",         "material",       "geometry",
      "lightprofile", "spectrum",  "color texture", "scalar texture", "vector texture",
      "shader",       "data",      "struct",        "array"};
  return kNames[static_cast<int>(type)];
}

std::size_t number_count(ParamType type) {
  switch (type) {
    case ParamType::Color:
      return 4;
    case ParamType::Vector:
      return 3;
    case ParamType::Transform:
      return 16;
    default:
      return 1;
  }
}

bool operator==(const UserData& a, const UserData& b) {
  return a.name == b.name && a.label == b.label && a.size == b.size && a.bytes == b.bytes &&
         a.file == b.file && a.declaration == b.declaration && a.arguments == b.arguments;
}

}  // namespace oriel::scene
