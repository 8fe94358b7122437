// SPDX-License-Identifier: Apache-2.0
// Divides the surfaces of a scene into cells by points on them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace oriel {

/// The main direction of a normal, 0 to 5: twice its longest axis, plus one if it points down it.
std::size_t main_side(const Vec3& normal);

/// A cell for each place of a surface.
///
/// Model:   for each of the six main directions of normals a binary tree over positions, halved
///          along the longest side of what the points fill until a leaf has few points. A cell is a
///          leaf.
/// Source:  T. Mueller, M. Gross, J. Novak, "Practical Path Guiding for Efficient Light-Transport
///          Simulation", 2017.
/// Checked: DirectionGuide.*
class SurfaceTree {
 public:
  struct Point {
    Vec3 position{0}, normal{0, 0, 1};
  };

  SurfaceTree() = default;
  explicit SurfaceTree(std::span<const Point> points);

  bool empty() const { return nodes_.empty(); }
  std::size_t cells() const { return cells_; }
  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + members_.size() * sizeof(Members) +
           order_.size() * sizeof(order_[0]);
  }
  /// The cell of a place, below cells(). Inputs:  normal: unit. Not for an empty tree.
  std::size_t find(const Vec3& position, const Vec3& normal) const {
    const Node* node = &nodes_[main_side(normal)];
    while (node->axis != kLeaf)
      node = &nodes_[node->child + (position[static_cast<int>(node->axis)] < node->split ? 0 : 1)];
    return node->child;
  }

  /// A value for each cell: mean(indices of points, above) of a node and the value of the node
  /// above, from all points down. `all` stands above that of all points.
  /// Not after forget_points().
  template <class Value, class Mean>
  std::vector<Value> values(const Value& all, const Mean& mean) const {
    std::vector<Value> of_nodes, of_cells(cells_, all);
    const Value first = mean(std::span<const std::uint32_t>(order_), all);
    of_nodes.reserve(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Members& m = members_[i];
      const Value& above = i < kSides ? first : of_nodes[m.above];
      of_nodes.push_back(
          mean(std::span<const std::uint32_t>(order_).subspan(m.begin, m.end - m.begin), above));
      if (nodes_[i].axis == kLeaf) of_cells[nodes_[i].child] = of_nodes.back();
    }
    return of_cells;
  }

  /// Releases the memory of the points, which only values() needs.
  void forget_points();

  /// Writes the tree without its points to a CheckpointWriter, or reads it from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    checkpoint.list(nodes_);
    checkpoint.value(cells_);
  }
  /// Whether find() ends at a cell for every place; of a tree that was read.
  bool is_valid() const;

 private:
  static constexpr std::size_t kSides = 6;
  static constexpr std::uint32_t kLeaf = 3;
  /// What find() reads, which is as small as possible for the processor's cache.
  struct Node {
    float split = 0;
    std::uint32_t axis : 2 = kLeaf;
    std::uint32_t child : 30 = 0;  ///< the lower half, followed by the upper; of a leaf: its cell
  };
  struct Members {
    std::uint32_t above = 0;           ///< node; not of roots
    std::uint32_t begin = 0, end = 0;  ///< its points in order_
  };
  void divide(std::uint32_t node, std::span<const Point> points, int depth);

  std::vector<Node> nodes_;       ///< the first six are roots; those above come first
  std::vector<Members> members_;  ///< of the nodes
  std::vector<std::uint32_t> order_;
  std::size_t cells_ = 0;
};

}  // namespace oriel
