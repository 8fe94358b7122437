// SPDX-License-Identifier: Apache-2.0
// C structures of elements that are accessed by name: elements made by shaders, and elements of the
// scene that are not part of the World.
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

/// The structure of a scene element and its size in bytes; null if unsupported.
///
/// Model:   instances, groups, lights, materials, user data, calls and declarations.
/// Checked: Elements.* in tests/user_shaders
std::unique_ptr<std::byte[]> element_record(Host& host, const std::string& name, std::size_t& size);

/// A group with all instances of the World, as content of the root.
std::unique_ptr<std::byte[]> root_record(Host& host, std::size_t& size);

/// The members of a light that describe shadow maps, which shaders can ask for.
void store_shadow_map(const scene::ShadowMap& from, miLight& out);

/// Matrices and identity of an instance, without tags.
miInstance c_instance(const scene::Instance& from);

}  // namespace oriel::sdk
