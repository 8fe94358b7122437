// SPDX-License-Identifier: Apache-2.0
// Reads unchecked JSON: every function returns a value for any input.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace oriel::models::gltf {

using nlohmann::json;

/// The member, or null if it does not exist.
const json& member(const json& object, const char* name);
const json& at(const json& list, std::size_t index);
/// A member of "extensions" of the object.
const json& extension(const json& object, const char* name);

/// The number if it is finite; else the fallback.
float number(const json& value, float fallback);
float number_at(const json& list, std::size_t index, float fallback);

/// A non-negative integer.
std::optional<std::size_t> whole(const json& value);
std::size_t whole(const json& value, std::size_t fallback);

/// The string, or empty if the value is not a string.
std::string words(const json& value);

}  // namespace oriel::models::gltf
