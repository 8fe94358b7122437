// SPDX-License-Identifier: Apache-2.0
// The C structures of elements that are reached by their names: those that shaders made, and those
// of the scene that have no place in the World.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "oriel/sdk/shader/scene.h"
#include "scene/element_settings.h"

namespace oriel::sdk {

class Host;

miScene_types type_of_element(const Host& host, const std::string& name);

/// The structure of an element of the scene, and its size in bytes; null: it has none.
///
/// Model:   instances, groups, lights, materials, user data, calls and declarations.
/// Checked: Elements.* in tests/user_shaders
std::unique_ptr<std::byte[]> element_record(Host& host, const std::string& name, std::size_t& size);

/// A group with all leaves of the World: what the root holds.
std::unique_ptr<std::byte[]> root_record(Host& host, std::size_t& size);

/// The members of a light that describe shadow maps, which shaders can ask for.
void store_shadow_map(const scene::ShadowMap& from, miLight& out);

/// Matrices and identity of an instance; without tags.
miInstance c_instance(const scene::Instance& from);

}  // namespace oriel::sdk
