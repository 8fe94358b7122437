// SPDX-License-Identifier: Apache-2.0
// Reads unchecked JSON: every function returns a value for any input.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace oriel::models::gltf {

using nlohmann::json;

/// Null where there is none.
const json& member(const json& object, const char* name);
const json& at(const json& list, std::size_t index);
/// Of the object's "extensions".
const json& extension(const json& object, const char* name);

/// Finite; else the fallback.
float number(const json& value, float fallback);
float number_at(const json& list, std::size_t index, float fallback);

/// A whole number that is not below 0, as sizes and indices are.
std::optional<std::size_t> whole(const json& value);
std::size_t whole(const json& value, std::size_t fallback);

/// Empty where it is no text.
std::string words(const json& value);

}  // namespace oriel::models::gltf
