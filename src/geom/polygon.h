// SPDX-License-Identifier: Apache-2.0
// Triangulates a polygon, which may be concave and have holes, without new vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/mesh.h"

namespace oriel::geom {

/// Triangulates polygons one after another and reuses its working memory.
///
/// Model:   the polygon is projected along the dominant axis of its Newell normal, so coordinates
///          stay exact. For outlines without self-intersection the triangle areas add up to the
///          area of the polygon; self-intersecting outlines get an approximate cover. Quads are
///          split along the shorter valid diagonal. A quad with crossing sides (a bow-tie, usually
///          corners in the wrong order) is replaced by the hull of its corners.
/// Checked: PolygonTriangulator.*
class PolygonTriangulator {
 public:
  /// Appends triangles as indices into `corners`, with the orientation of the outline.
  ///
  /// Inputs:  corners: finite; the outline, then each hole, in either orientation. holes: index of
  ///          the first corner of each hole, ascending.
  /// Returns: false if the polygon has no area; nothing is appended then.
  bool triangulate(std::span<const Vec3> corners, std::span<const std::uint32_t> holes,
                   std::vector<Triangle>& out);

 private:
  struct Node {
    double x, y;
    std::uint32_t corner;
    std::uint32_t prev = 0, next = 0;
    std::uint32_t next_in_cell = kNone;
    std::uint32_t first_waiting = kNone;  ///< nodes whose ear this one blocks
    std::uint32_t stamp = 0;              ///< of its latest queue entry
    bool reflex = false, removed = false;
  };
  struct Queued {
    std::uint32_t node, stamp;
  };
  struct Waiting {
    std::uint32_t node, next;
  };
  enum class Rule : std::uint8_t { Strict, Touching, DropFlat, AnyConvex, AnyConcave, Discard };

  enum class Join : std::uint8_t { Outside, AtNode, OnSide, Across };
  struct Bridge {
    Join join;
    std::uint32_t node;  ///< of the outline: same position, begin of the edge, far end
  };

  bool choose_plane(std::span<const Vec3> outline);
  bool cut_quad(std::span<const Vec3> corners, std::vector<Triangle>& out) const;
  bool is_convex(std::span<const Vec3> outline) const;
  std::uint32_t add_loop(std::span<const Vec3> corners, std::uint32_t begin, std::uint32_t end,
                         bool counter_clockwise);
  void bridge_holes(std::uint32_t outline, std::vector<std::uint32_t>& rightmost);
  Bridge find_bridge(std::uint32_t outline, const Node& m) const;
  void link(std::uint32_t from, std::uint32_t to);
  std::uint32_t copy_node(std::uint32_t node);
  void clip_ears(std::uint32_t start, std::vector<Triangle>& out);
  bool try_clip(std::uint32_t v, Rule rule, std::vector<Triangle>& out);
  void unlink(std::uint32_t v);
  void build_grid(std::uint32_t start);
  std::uint32_t find_blocker(const Node& a, const Node& b, const Node& c, bool touching_blocks);
  void enqueue(std::uint32_t v);
  void wake(std::uint32_t blocker);
  int row_of(double y) const;
  int column_of(double x) const;
  bool locally_inside(const Node& p, const Node& q) const;
  double turn(const Node& p, const Node& q, const Node& r) const;
  void update(std::uint32_t v);

  int axis_x_ = 0, axis_y_ = 1;  ///< swapped if the outline would be clockwise
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> cells_, rightmost_;
  std::vector<Queued> queue_;
  std::vector<Waiting> waiting_;
  /// current number of nodes, and that when the grid was built
  std::size_t alive_ = 0, in_grid_ = 0;
  int columns_ = 1, rows_ = 1;
  double grid_x_ = 0, grid_y_ = 0, cell_width_ = 1, cell_height_ = 1;
  std::int64_t work_left_ = 0;
};

}  // namespace oriel::geom
