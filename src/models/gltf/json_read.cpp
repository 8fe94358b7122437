// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/json_read.h"

#include <cmath>
#include <cstdint>

namespace oriel::models::gltf {
namespace {

const json& nothing() {
  static const json null;
  return null;
}

}  // namespace

const json& member(const json& object, const char* name) {
  if (!object.is_object()) return nothing();
  const auto found = object.find(name);
  return found == object.end() ? nothing() : *found;
}

const json& at(const json& list, std::size_t index) {
  return list.is_array() && index < list.size() ? list[index] : nothing();
}

const json& extension(const json& object, const char* name) {
  return member(member(object, "extensions"), name);
}

float number(const json& value, float fallback) {
  if (!value.is_number()) return fallback;
  const auto x = value.get<double>();
  constexpr double kLargest = 3.4e38;
  return std::fabs(x) <= kLargest ? static_cast<float>(x) : fallback;
}

float number_at(const json& list, std::size_t index, float fallback) {
  return number(at(list, index), fallback);
}

std::optional<std::size_t> whole(const json& value) {
  // Larger doubles are not exact integers.
  constexpr std::uint64_t kMax = std::uint64_t{1} << 53;
  if (value.is_number_integer()) {
    if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0) return std::nullopt;
    const auto n = value.get<std::uint64_t>();
    return n <= kMax ? std::optional<std::size_t>(n) : std::nullopt;
  }
  if (!value.is_number_float()) return std::nullopt;
  const auto x = value.get<double>();
  if (!(x >= 0 && x <= static_cast<double>(kMax)) || x != std::floor(x)) return std::nullopt;
  return static_cast<std::size_t>(x);
}

std::size_t whole(const json& value, std::size_t fallback) {
  return whole(value).value_or(fallback);
}

std::string words(const json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace oriel::models::gltf
