// SPDX-License-Identifier: Apache-2.0
// Triangles cut finer at edges, without cracks: what displacement needs for its detail.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh.h"

namespace oriel::geom {

/// Halves edges of a mesh, once per pass.
///
/// Model:   an edge is known by the places of its ends, whatever vertices stand there: if any of
/// the
///          triangles at it asks, all of them split it at the same place, so no T-junction arises
///          even across seams of texture coordinates. A triangle with one, two or three edges to
///          split becomes two, three or four. New vertices lie in the middle, with the mean of all
///          columns; normals are made unit again, and null where one end's is.
/// Checked: EdgeSplitter.*
class EdgeSplitter {
 public:
  /// The mesh must outlive the splitter and only be changed by it.
  explicit EdgeSplitter(Mesh& mesh);

  /// Splits the edges for which wants(triangle, vertex, vertex) holds for any of their triangles.
  /// Returns whether there were any. When more than `most` triangles would result nothing is split
  /// and `exceeded` set.
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
  using Key = std::uint64_t;  // of two numbers, the smaller one above
  static Key key(std::uint32_t a, std::uint32_t b) {
    return a < b ? Key{a} << 32 | b : Key{b} << 32 | a;
  }
  static std::uint32_t rank(const std::vector<Key>& keys, Key k);
  bool split(std::vector<Key> marked, std::size_t most);
  void add_vertices(const std::vector<Key>& marked, const std::vector<Key>& edges);
  void cut_triangles(const std::vector<Key>& edges, std::size_t total);

  Mesh& mesh_;
  std::vector<std::uint32_t> place_;  // per vertex: the same number where positions are equal
  std::uint32_t places_ = 0;
};

/// Numbers vertices by their positions, from 0; equal ones share a number. Returns how many there
/// are.
std::uint32_t number_places(const Mesh& mesh, std::vector<std::uint32_t>& place);

/// Gives each triangle its own vertices with its facet's normal, where a mesh has no normals.
void add_facet_normals(Mesh& mesh);

}  // namespace oriel::geom
