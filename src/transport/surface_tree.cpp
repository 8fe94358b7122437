// SPDX-License-Identifier: Apache-2.0
#include "transport/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geom/mesh.h"

namespace oriel {
namespace {

/// Maximum number of points of a cell. 1 to 4 differ little.
constexpr std::uint32_t kPointsOfCell = 4;
constexpr int kDeepestCell = 32;
/// More nodes than any tree of points has, which coarse records limit.
constexpr std::uint32_t kMostNodes = (1u << 30) - 1;

}  // namespace

std::size_t main_side(const Vec3& n) {
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  return 2 * static_cast<std::size_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

SurfaceTree::SurfaceTree(std::span<const Point> points) {
  if (points.empty()) return;
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.resize(kSides);
  members_.resize(kSides);
  auto begin = order_.begin();
  for (std::uint32_t side = 0; side < kSides; ++side) {
    const auto end = std::stable_partition(
        begin, order_.end(), [&](std::uint32_t i) { return main_side(points[i].normal) == side; });
    members_[side].begin = static_cast<std::uint32_t>(begin - order_.begin());
    members_[side].end = static_cast<std::uint32_t>(end - order_.begin());
    divide(side, points, 0);
    begin = end;
  }
}

void SurfaceTree::forget_points() {
  order_ = {};
  members_ = {};
}

bool SurfaceTree::is_valid() const {
  if (nodes_.empty()) return cells_ == 0;
  if (nodes_.size() < kSides) return false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.axis == kLeaf) {
      if (node.child >= cells_) return false;
      continue;
    }
    // Children after their node, so that a search ends.
    if (node.child <= i || node.child >= nodes_.size() - 1) return false;
  }
  return true;
}

void SurfaceTree::divide(std::uint32_t index, std::span<const Point> points, int depth) {
  const Members node = members_[index];
  if (node.end - node.begin <= kPointsOfCell || depth == kDeepestCell) {
    nodes_[index].child = static_cast<std::uint32_t>(cells_++) & kMostNodes;
    return;
  }
  const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  geom::Box3 box;
  for (auto i = at(node.begin); i != at(node.end); ++i) box.extendBy(points[*i].position);
  const Vec3 size = box.size();
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const float split = 0.5f * (box.min[axis] + box.max[axis]);
  const auto found = std::stable_partition(at(node.begin), at(node.end), [&](std::uint32_t i) {
    return points[i].position[axis] < split;
  });
  const auto middle = static_cast<std::uint32_t>(found - order_.begin());
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].split = split;
  nodes_[index].axis = static_cast<std::uint32_t>(axis) & kLeaf;
  nodes_[index].child = child & kMostNodes;
  nodes_.resize(nodes_.size() + 2);
  members_.push_back({.above = index, .begin = node.begin, .end = middle});
  members_.push_back({.above = index, .begin = middle, .end = node.end});
  divide(child, points, depth + 1);
  divide(child + 1, points, depth + 1);
}

}  // namespace oriel
