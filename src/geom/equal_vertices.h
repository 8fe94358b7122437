// SPDX-License-Identifier: Apache-2.0
// Which vertices of a list are written alike: exporters that write one for each corner repeat them.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/object.h"

namespace oriel::geom {

struct DifferentVertices {
  std::vector<std::uint32_t> kept;       ///< one vertex of each kind, ascending
  std::vector<std::uint32_t> number_of;  ///< per vertex of the list: its kind, an index into kept
};

/// Finds vertices whose fields are the same indices: they are the same vertex. The fields that a
/// mesh does not hold (user) do not count.
///
/// Model:   a vertex is compared with the last few kinds at the same point, so that a point with
///          thousands of different normals costs no more than any other.
/// Inputs:  vectors: size of the group's pool.
/// Checked: Tessellate.VerticesWrittenAlikeBecomeOne
DifferentVertices find_equal_vertices(const scene::VertexList& list, std::size_t vectors);

}  // namespace oriel::geom
