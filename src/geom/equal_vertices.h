// SPDX-License-Identifier: Apache-2.0
// Finds duplicate vertices in a list: some exporters repeat a vertex for each corner.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/object.h"

namespace oriel::geom {

struct DifferentVertices {
  std::vector<std::uint32_t> kept;       ///< first vertex of each group of equal ones, ascending
  std::vector<std::uint32_t> number_of;  ///< per vertex of the list: its index in kept
};

/// Finds vertices whose fields have equal indices. Fields that a mesh does not store (user) are
/// ignored.
///
/// Model:   a vertex is compared with the last few distinct vertices at the same point only, so
///          that a point with thousands of different normals does not take quadratic time.
/// Inputs:  vectors: size of the vector pool of the group.
/// Checked: Tessellate.EqualVerticesAreMerged
DifferentVertices find_equal_vertices(const scene::VertexList& list, std::size_t vectors);

}  // namespace oriel::geom
