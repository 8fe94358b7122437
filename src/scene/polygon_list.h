// SPDX-License-Identifier: Apache-2.0
// Lists of faces: corners and materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel::scene {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Polygons of a group, or the base faces of a subdivision surface. Polygon i has the corners
/// indices[first[i]] .. indices[first[i+1]-1]. `holes` contains the offset in `indices` of the
/// first corner of each hole, ascending over the group. Strips and fans are stored as triangles.
struct PolygonList {
  std::vector<std::uint32_t> indices;  ///< into the vertex list
  std::vector<std::uint32_t> first;    ///< polygons + 1 entries; empty if there are none
  std::vector<std::uint32_t> holes;    ///< offsets into indices
  /// Empty, or one per polygon: index into PolygonGroup::materials, or the label in a tagged
  /// object. kNone: the material of the instance.
  std::vector<std::uint32_t> material;
  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  bool operator==(const PolygonList&) const = default;
};

}  // namespace oriel::scene
