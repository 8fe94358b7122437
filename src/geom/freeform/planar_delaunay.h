// SPDX-License-Identifier: Apache-2.0
// Constrained Delaunay triangulation of points on an integer grid, with incremental insertion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace oriel::geom::freeform {

/// A point of the grid; x and y in [0, PlanarDelaunay::kSize].
struct GridPoint {
  std::int64_t x = 0, y = 0;
  bool operator==(const GridPoint&) const = default;
};

/// Model:   a triangle around the whole grid is split as points are inserted. Edges are flipped
///          until no circumcircle contains a vertex, except where fixed edges prevent it. All
///          predicates are exact: coordinates are integers that are small enough for 128-bit
///          arithmetic.
/// Source:  C. Lawson, "Software for C1 surface interpolation", 1977 (insertion by flips);
///          S. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993.
/// Checked: PlanarDelaunay.*
class PlanarDelaunay {
 public:
  static constexpr std::int64_t kSize = std::int64_t{1} << 26;
  /// The first vertices are the corners of the enclosing triangle.
  static constexpr std::uint32_t kCorners = 3;
  static constexpr std::uint32_t kNothing = 0xffffffffu;

  struct Face {
    std::array<std::uint32_t, 3> vertex;  ///< counter-clockwise
    std::array<std::uint32_t, 3> across;  ///< the face beyond the edge opposite to vertex i
    std::array<bool, 3> fixed;            ///< that edge is a constraint
    std::uint8_t region = 0;              ///< set by the caller; new faces inherit it
  };

  PlanarDelaunay();
  /// The vertex at the point; inserts it if it does not exist.
  std::uint32_t insert(GridPoint p);
  /// Like insert(), but only in faces of the region and at least `distance` from each vertex and
  /// fixed edge of its face; otherwise returns kNothing.
  std::uint32_t insert_clear(GridPoint p, double distance, std::uint8_t region);
  /// Makes the segment from a to b fixed edges, split at vertices that lie on it. Returns false if
  /// the segment crosses another fixed edge; the rest of the segment is then skipped.
  bool fix_edge(std::uint32_t a, std::uint32_t b);

  const std::vector<GridPoint>& points() const { return points_; }
  std::vector<Face>& faces() { return faces_; }

 private:
  struct Found {
    std::uint32_t face;
    int vertex = -1;  ///< vertex of the face that equals the point
    int edge = -1;    ///< or the edge opposite to this vertex that contains it
  };
  Found locate(GridPoint p) const;
  std::uint32_t insert_at(const Found& found, GridPoint p);
  void split_face(std::uint32_t face, std::uint32_t p);
  void split_edge(std::uint32_t face, int edge, std::uint32_t p);
  void set_face(std::uint32_t face, const Face& value);
  void relink(std::uint32_t face, std::uint32_t from, std::uint32_t to);
  void legalize();
  bool should_flip(std::uint32_t face, int edge) const;
  void flip(std::uint32_t face, int edge);
  int index_of(std::uint32_t face, std::uint32_t vertex) const;
  bool find_edge(std::uint32_t a, std::uint32_t b, std::uint32_t& face, int& edge) const;
  void fix(std::uint32_t face, int edge);
  bool clear_way(std::uint32_t a, std::uint32_t b, std::uint32_t first_face, int first_edge,
                 std::uint32_t& reached);

  std::vector<GridPoint> points_;
  std::vector<std::uint32_t> face_of_;  // one face at each vertex
  std::vector<Face> faces_;
  mutable std::uint32_t last_ = 0;
  std::vector<std::pair<std::uint32_t, int>> suspects_;  // edges to test for a flip
};

}  // namespace oriel::geom::freeform
