// SPDX-License-Identifier: Apache-2.0
// Lists of faces as a scene holds them: corners, and what each face is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel::scene {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Polygons of a group, or the base faces of a subdivision surface. Polygon i has the corners
/// indices[first[i]] .. indices[first[i+1]-1]; where it has holes, `holes` lists the offsets in
/// `indices` at which each hole's loop begins (ascending over the whole group). Strips and fans are
/// stored as triangles.
struct PolygonList {
  std::vector<std::uint32_t> indices;  ///< into the vertex list
  std::vector<std::uint32_t> first;    ///< polygons + 1 entries; empty when there are none
  std::vector<std::uint32_t> holes;    ///< offsets into indices
  /// Empty, or one per polygon: index into PolygonGroup::materials, or in a tagged object the label
  /// itself; kNone = the instance supplies the material.
  std::vector<std::uint32_t> material;
  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  bool operator==(const PolygonList&) const = default;
};

}  // namespace oriel::scene
