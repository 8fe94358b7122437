// SPDX-License-Identifier: Apache-2.0
// Reads accessors of glTF files.
#pragma once

#include <cstdint>
#include <vector>

#include "models/gltf/buffers.h"

namespace oriel::models::gltf {

/// Elements with a fixed number of components, stored consecutively.
struct Column {
  std::size_t components = 0;
  std::vector<float> values;
  std::size_t count() const { return components > 0 ? values.size() / components : 0; }
};

/// Data type of an accessor.
struct NumberFormat {
  int component_type = 0;  ///< 5120 .. 5126
  bool normalized = false;
  std::size_t components = 1, count = 0;
  std::size_t component_size() const;  ///< bytes
  /// The value of a stored component.
  /// Source:  glTF 2.0, 3.6.2.2 and 3.11 (c / 127 of signed bytes, not below -1, and so on).
  float meaning(double stored) const;
};
/// Errors:  Unreadable.
NumberFormat number_format(const json& root, std::size_t accessor);

/// All values of an accessor, with sparse elements resolved and normalized integers as fractions.
/// Errors:  Unreadable.
/// Source:  glTF 2.0, 3.6.2; KHR_mesh_quantization.
/// Checked: GltfAccessor.*
Column read_numbers(const json& root, Buffers& buffers, std::size_t accessor);

/// Reads an accessor of integers, for vertex indices.
/// Errors:  Unreadable.
std::vector<std::uint32_t> read_indices(const json& root, Buffers& buffers, std::size_t accessor);

}  // namespace oriel::models::gltf
