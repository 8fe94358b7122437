// SPDX-License-Identifier: Apache-2.0
// Meaning of tags.
#pragma once

#include <cstdint>

#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

/// Kind of a tag in its upper bits; selects the list that contains the element.
enum class TagKind : std::uint8_t {
  None,
  Function,       ///< Host's list of shaders with tags
  Declaration,    ///< Host's list of user shaders
  Texture,        ///< Host's list of textures with tags
  Text,           ///< Host's list of strings
  LightInstance,  ///< index into World::lights
  Light,          ///< same, the light element of the instance
  UserData,       ///< Host's list
  Material,       ///< index into World::materials
  Instance,       ///< index into World::instances
  Object,         ///< same, the object of the instance
  Camera,
  CameraInstance,
  Options,
  Root,
  Profile,  ///< Host's list
  Made,     ///< elements of the scene by name, including those made by shaders
  Element   ///< by mi_db_create or mi_kdtree_create, ShaderElements
};

inline constexpr unsigned kIndexBits = 26;
inline constexpr miTag kMaxIndex = (1u << kIndexBits) - 2;

/// `index` starts at 0.
constexpr miTag make_tag(TagKind kind, std::size_t index) {
  return (static_cast<miTag>(kind) << kIndexBits) | (static_cast<miTag>(index) + 1);
}
constexpr TagKind kind_of(miTag tag) { return static_cast<TagKind>(tag >> kIndexBits); }
constexpr std::size_t index_of(miTag tag) { return (tag & ((1u << kIndexBits) - 1)) - 1; }

}  // namespace oriel::sdk
