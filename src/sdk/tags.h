// SPDX-License-Identifier: Apache-2.0
// What a tag stands for.
#pragma once

#include <cstdint>

#include "oriel/sdk/shader/types.h"

namespace oriel::sdk {

/// The upper bits of a tag: in which list its element stands.
enum class TagKind : std::uint8_t {
  None,
  Function,       ///< Host's list of shaders that have tags
  Declaration,    ///< Host's list of the users' shaders
  Texture,        ///< Host's list of textures that have tags
  Text,           ///< Host's list of strings
  LightInstance,  ///< World::lights
  Light,          ///< the same, the element that is placed
  UserData,       ///< Host's list
  Material,       ///< World::materials
  Instance,       ///< World::instances
  Object,         ///< the same, what is placed
  Camera,
  CameraInstance,
  Options,
  Root,
  Profile,  ///< Host's list
  Made,     ///< elements of the scene by name, those that shaders made as well
  Element   ///< by mi_db_create or mi_kdtree_create, ShaderElements
};

inline constexpr unsigned kIndexBits = 26;
inline constexpr miTag kMostIndex = (1u << kIndexBits) - 2;

/// Index counts from 0.
constexpr miTag make_tag(TagKind kind, std::size_t index) {
  return (static_cast<miTag>(kind) << kIndexBits) | (static_cast<miTag>(index) + 1);
}
constexpr TagKind kind_of(miTag tag) { return static_cast<TagKind>(tag >> kIndexBits); }
constexpr std::size_t index_of(miTag tag) { return (tag & ((1u << kIndexBits) - 1)) - 1; }

}  // namespace oriel::sdk
