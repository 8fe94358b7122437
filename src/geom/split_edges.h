// SPDX-License-Identifier: Apache-2.0
// Refines triangles at edges without cracks, for displacement.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh.h"

namespace oriel::geom {

/// Halves edges of a mesh, once per pass.
///
/// Model:   edges are identified by the positions of their ends, independent of vertex indices. If
///          any adjacent triangle requests a split, all adjacent triangles split the edge at the
///          same point, so there are no T-junctions, even across seams of texture coordinates. A
///          triangle with one, two or three split edges becomes two, three or four triangles. New
///          vertices are the middle, with the mean of all columns. Normals are renormalised; a
///          normal is null if that of one end is.
/// Checked: EdgeSplitter.*
class EdgeSplitter {
 public:
  /// The mesh must outlive the splitter and must not be changed by other code.
  explicit EdgeSplitter(Mesh& mesh);

  /// Splits the edges for which wants(triangle, vertex, vertex) is true for any of their triangles.
  /// Returns whether any edge was split. If the result would have more than `most` triangles,
  /// nothing is split and `exceeded` is set.
  template <typename Wants>
  bool pass(Wants&& wants, std::size_t most) {
    std::vector<Key> marked;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Triangle& t = mesh_.triangles[i];
      if (wants(i, t.a, t.b)) marked.push_back(key(place_[t.a], place_[t.b]));
      if (wants(i, t.b, t.c)) marked.push_back(key(place_[t.b], place_[t.c]));
      if (wants(i, t.c, t.a)) marked.push_back(key(place_[t.c], place_[t.a]));
    }
    return split(std::move(marked), most);
  }

  bool exceeded = false;

 private:
  using Key = std::uint64_t;  // two indices, the smaller one in the upper half
  static Key key(std::uint32_t a, std::uint32_t b) {
    return a < b ? Key{a} << 32 | b : Key{b} << 32 | a;
  }
  static std::uint32_t rank(const std::vector<Key>& keys, Key k);
  bool split(std::vector<Key> marked, std::size_t most);
  void add_vertices(const std::vector<Key>& marked, const std::vector<Key>& edges);
  void cut_triangles(const std::vector<Key>& edges, std::size_t total);

  Mesh& mesh_;
  std::vector<std::uint32_t> place_;  // per vertex; equal positions have equal numbers
  std::uint32_t places_ = 0;
};

/// Numbers the distinct positions of the vertices from 0. Returns their count.
std::uint32_t number_places(const Mesh& mesh, std::vector<std::uint32_t>& place);

/// Gives each triangle separate vertices with its geometric normal, if the mesh has no normals.
void add_facet_normals(Mesh& mesh);

}  // namespace oriel::geom
