// SPDX-License-Identifier: Apache-2.0
// Constrained Delaunay triangulation of points on an integer grid, grown point by point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace oriel::geom::freeform {

/// A place of the grid; x and y in [0, PlanarDelaunay::kSize].
struct GridPoint {
  std::int64_t x = 0, y = 0;
  bool operator==(const GridPoint&) const = default;
};

/// Model:   a triangle around the whole grid is split as points come, and edges are flipped until
///          no point lies in a triangle's circumcircle unless a fixed edge stands between. All
///          decisions are exact: coordinates are integers small enough for 128 bits.
/// Source:  C. Lawson, "Software for C1 surface interpolation", 1977 (insertion by flips);
///          S. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993.
/// Checked: PlanarDelaunay.*
class PlanarDelaunay {
 public:
  static constexpr std::int64_t kSize = std::int64_t{1} << 26;
  /// The first vertices are the corners of the triangle around all.
  static constexpr std::uint32_t kCorners = 3;
  static constexpr std::uint32_t kNothing = 0xffffffffu;

  struct Face {
    std::array<std::uint32_t, 3> vertex;  ///< counter-clockwise
    std::array<std::uint32_t, 3> across;  ///< the face beyond the edge opposite to vertex i
    std::array<bool, 3> fixed;            ///< that edge is a constraint
    std::uint8_t region = 0;              ///< the caller's; new faces have that of the old ones
  };

  PlanarDelaunay();
  /// The vertex there, new or not.
  std::uint32_t insert(GridPoint p);
  /// As insert(), but only in faces of that region, and nowhere closer to a vertex or to a fixed
  /// edge of its face than `distance`; otherwise kNothing.
  std::uint32_t insert_clear(GridPoint p, double distance, std::uint8_t region);
  /// Makes the straight way from a to b edges that stay, through the vertices that lie on it.
  /// False: it crosses another fixed edge and was left out from there on.
  bool fix_edge(std::uint32_t a, std::uint32_t b);

  const std::vector<GridPoint>& points() const { return points_; }
  std::vector<Face>& faces() { return faces_; }

 private:
  struct Found {
    std::uint32_t face;
    int vertex = -1;  ///< it is this one of the face
    int edge = -1;    ///< or on the edge opposite to this one
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
  std::vector<std::pair<std::uint32_t, int>> suspects_;  // edges that may have to be flipped
};

}  // namespace oriel::geom::freeform
