// SPDX-License-Identifier: Apache-2.0
// Accessors of glTF files as plain numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "models/gltf/buffers.h"

namespace oriel::models::gltf {

/// Elements of so many numbers each, one after the other.
struct Column {
  std::size_t components = 0;
  std::vector<float> values;
  std::size_t count() const { return components > 0 ? values.size() / components : 0; }
};

/// What an accessor says of its numbers.
struct NumberFormat {
  int component_type = 0;  ///< 5120 .. 5126
  bool normalized = false;
  std::size_t components = 1, count = 0;
  std::size_t component_size() const;  ///< bytes
  /// The number that a stored one stands for.
  /// Source:  glTF 2.0, 3.6.2.2 and 3.11 (c / 127 of signed bytes, not below -1, and so on).
  float meaning(double stored) const;
};
/// Errors:  Unreadable.
NumberFormat number_format(const json& root, std::size_t accessor);

/// All numbers of an accessor, sparse ones in place, normalized ones as fractions.
/// Errors:  Unreadable.
/// Source:  glTF 2.0, 3.6.2; KHR_mesh_quantization.
/// Checked: GltfAccessor.*
Column read_numbers(const json& root, Buffers& buffers, std::size_t accessor);

/// An accessor of whole numbers, as corners are.
/// Errors:  Unreadable.
std::vector<std::uint32_t> read_indices(const json& root, Buffers& buffers, std::size_t accessor);

}  // namespace oriel::models::gltf
