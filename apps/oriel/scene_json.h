// SPDX-License-Identifier: Apache-2.0
// Elements of a scene as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/scene.h"

namespace oriel::app {

/// The list of a dump that contains an element: "cameras", "lights", "materials" or "shaders"; ""
/// for elements that the other lists of a dump contain.
std::string element_list(const scene::Element& element);

/// An element of one of these lists with its statements and shader calls as written; null for
/// others.
nlohmann::json element_json(const scene::Element& element);

}  // namespace oriel::app
