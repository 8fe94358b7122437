// SPDX-License-Identifier: Apache-2.0
#include "transport/direction_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oriel {
namespace {

constexpr std::size_t kSides = 6;
/// Maximum number of points of a leaf, and what the node above counts, in points. 1 to 4, and .5 to
/// 1.5, differ little.
constexpr std::size_t kPointsOfLeaf = 4;
constexpr float kWeightAbove = 0.5f;
constexpr int kMaxDepth = 32;

/// The main direction of a normal: twice its longest axis, plus one if it points down that axis.
std::size_t guide_side(const Vec3& n) {
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  return 2 * static_cast<std::size_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

/// The entry of increasing shares that contains u, and where in it, both as a coordinate.
struct Found {
  std::size_t index;
  float coordinate;
};
Found find_share(const float* until, float u) {
  std::size_t i = 0;
  for (std::size_t k = 0; k + 1 < kGuideSide; ++k) i += until[k] <= u ? 1 : 0;
  const float from = i > 0 ? until[i - 1] : 0, size = until[i] - from;
  const float within = size > 0 ? clamp((u - from) / size, 0, 0x1.fffffep-1f) : 0.5f;
  return {i, (static_cast<float>(i) + within) / kGuideSide};
}

}  // namespace

std::size_t guide_cell(const Vec2& at) {
  const auto along = [](float x) {
    return static_cast<std::size_t>(clamp(x * kGuideSide, 0, kGuideSide - 1));
  };
  return along(at.y) * kGuideSide + along(at.x);
}

Frame guide_frame(const Vec3& normal) {
  Vec3 tangent(0);
  tangent[static_cast<int>((guide_side(normal) / 2 + 1) % 3)] = 1;
  return Frame::along(normal, tangent);
}

GuideDensity::GuideDensity(const GuideSquare& light) {
  double sum = 0;  // double: shares must add up to 1
  for (const float l : light) sum += static_cast<double>(l);
  const float scale = sum > 0 ? static_cast<float>((1 - kUnguided) * kGuideCells / sum) : 0;
  for (std::size_t i = 0; i < kGuideCells; ++i)
    density_[i] = sum > 0 ? kUnguided + scale * light[i] : 1;
  double rows = 0;
  for (std::size_t row = 0; row < kGuideSide; ++row) {
    const auto begin = density_.begin() + static_cast<std::ptrdiff_t>(row * kGuideSide);
    const double of_row = std::accumulate(begin, begin + kGuideSide, 0.0);
    double until = 0;
    for (std::size_t i = row * kGuideSide; i < (row + 1) * kGuideSide; ++i)
      until_[i] = static_cast<float>((until += static_cast<double>(density_[i])) / of_row);
    rows_until_[row] = static_cast<float>((rows += of_row) / kGuideCells);
  }
}

Vec2 GuideDensity::sample(const Vec2& u, float& density) const {
  const Found row = find_share(rows_until_.data(), u.y);
  const Found column = find_share(&until_[row.index * kGuideSide], u.x);
  density = density_[row.index * kGuideSide + column.index];
  return Vec2(column.coordinate, row.coordinate);
}

LocalGuide DirectionGuide::at(const Vec3& position, const Vec3& normal) const {
  const Node* node = &nodes_[guide_side(normal)];
  while (node->axis >= 0)
    node = &nodes_[node->child + (position[node->axis] < node->split ? 0 : 1)];
  return {densities_[node->child], guide_frame(normal)};
}

/// Builds the trees of a guide.
class GuideBuilder {
 public:
  GuideBuilder(DirectionGuide& guide, std::span<const GuidePoint> points)
      : guide_(guide), points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void build(const geom::Box3& bounds) {
    guide_.nodes_.resize(kSides);
    const GuideSquare all = light_of({order_.begin(), order_.end()}, GuideSquare{});
    auto begin = order_.begin();
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const auto end = std::stable_partition(begin, order_.end(), [&](std::uint32_t i) {
        return guide_side(points_[i].normal) == side;
      });
      divide(side, bounds, {begin, end}, all, 0);
      begin = end;
    }
  }

 private:
  using Indices = std::span<std::uint32_t>;

  /// Mean of the points and of the light above.
  GuideSquare light_of(Indices points, const GuideSquare& above) const {
    GuideSquare light;
    for (std::size_t k = 0; k < kGuideCells; ++k) light[k] = kWeightAbove * above[k];
    for (const std::uint32_t i : points)
      for (std::size_t k = 0; k < kGuideCells; ++k) light[k] += points_[i].light[k];
    const float scale = 1 / (static_cast<float>(points.size()) + kWeightAbove);
    for (float& l : light) l *= scale;
    return light;
  }

  void divide(std::uint32_t node, const geom::Box3& box, Indices points, const GuideSquare& above,
              int depth) {
    const GuideSquare light = light_of(points, above);
    if (points.size() <= kPointsOfLeaf || depth == kMaxDepth) {
      guide_.nodes_[node].child = static_cast<std::uint32_t>(guide_.densities_.size());
      guide_.densities_.emplace_back(light);
      return;
    }
    const Vec3 size = box.max - box.min;
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const float split = 0.5f * (box.min[axis] + box.max[axis]);
    const auto middle = std::stable_partition(points.begin(), points.end(), [&](std::uint32_t i) {
      return points_[i].position[axis] < split;
    });
    const auto child = static_cast<std::uint32_t>(guide_.nodes_.size());
    guide_.nodes_.resize(guide_.nodes_.size() + 2);
    guide_.nodes_[node] = {split, axis, child};
    geom::Box3 low = box, high = box;
    low.max[axis] = high.min[axis] = split;
    divide(child, low, {points.begin(), middle}, light, depth + 1);
    divide(child + 1, high, {middle, points.end()}, light, depth + 1);
  }

  DirectionGuide& guide_;
  std::span<const GuidePoint> points_;
  std::vector<std::uint32_t> order_;
};

DirectionGuide::DirectionGuide(const geom::Box3& bounds, std::span<const GuidePoint> points) {
  if (!points.empty()) GuideBuilder(*this, points).build(bounds);
}

}  // namespace oriel
