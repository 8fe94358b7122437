// SPDX-License-Identifier: Apache-2.0
// Which points of a set lie near a place? Points have any number of coordinates and carry data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

namespace oriel::geom {

/// A kd-tree that grows: balanced trees of 1, 2, 4, 8, ... points, of which equal ones are merged
/// when a point is added.
///
/// Model:   points keep their addresses until the tree goes. All functions are safe to call from
///          all threads at once.
/// Source:  Bentley, Saxe, "Decomposable Searching Problems I", Journal of Algorithms 1, 1980.
/// Checked: PointTree.FindsWhatASearchOfAllPointsFinds
class PointTree {
 public:
  static constexpr int kMostDimensions = 64;
  static constexpr std::size_t kMostData = 65536;  ///< bytes of a point's data

  /// Inputs: dimensions: 1 to kMostDimensions; data_size: 0 to kMostData.
  PointTree(int dimensions, std::size_t data_size);
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  struct Point {
    const float* place;  ///< `dimensions` coordinates
    void* data;
  };
  struct Near {
    Point point;
    float distance;
  };

  /// Copies the coordinates and the data; null data is zeros. False: a coordinate is no number.
  bool add(const float* place, const void* data);
  /// The points within `radius` of a place, at most `most` of them, nearest first; points of equal
  /// distance in the order in which they were added.
  std::vector<Near> near(const float* place, float radius, std::size_t most) const;
  /// All points in the order in which they were added.
  std::vector<Point> all() const;

  std::size_t bytes() const;

 private:
  using Index = std::uint32_t;
  /// Implicit: the middle of a range divides it along a coordinate, which changes with depth.
  using Level = std::vector<Index>;
  struct Search;

  Point point(Index i) const;
  void arrange(std::span<Index> range, int axis) const;
  void visit(std::span<const Index> range, int axis, Search& search) const;

  const std::size_t dimensions_, data_size_, stride_;
  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<std::byte[]>> points_;  ///< coordinates, then data
  std::vector<Level> levels_;                         ///< the k-th has 2^k points or none
};

}  // namespace oriel::geom
