// SPDX-License-Identifier: Apache-2.0
// Builds a glTF file whose buffer contains only floats, vertex indices and images.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

class PlainFile {
 public:
  json root = json::object();

  /// Each function returns the index of the added object.
  std::size_t add_view(std::string_view content);
  std::size_t add_numbers(const std::vector<float>& values, std::size_t components);
  /// Of three components, with their bounds, as positions must have them.
  std::size_t add_points(const std::vector<float>& values);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);

  /// The complete binary file.
  std::string binary() const;

 private:
  std::size_t add_accessor(std::string_view content, int component_type, std::size_t count,
                           const char* type);

  json views_ = json::array(), accessors_ = json::array();
  std::string bytes_;
};

}  // namespace oriel::models::gltf
