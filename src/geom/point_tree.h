// SPDX-License-Identifier: Apache-2.0
// Nearest-neighbour search in a set of points with any number of coordinates and attached data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

namespace oriel::geom {

/// A dynamic kd-tree: balanced trees of 1, 2, 4, 8, ... points. Adding a point merges trees of
/// equal size.
///
/// Model:   the addresses of points are stable while the tree exists. All functions are
///          thread-safe.
/// Source:  Bentley, Saxe, "Decomposable Searching Problems I", Journal of Algorithms 1, 1980.
/// Checked: PointTree.MatchesBruteForceSearch
class PointTree {
 public:
  static constexpr int kMaxDimensions = 64;
  static constexpr std::size_t kMaxData = 65536;  ///< bytes of a point's data

  /// Inputs: dimensions: 1 to kMaxDimensions; data_size: 0 to kMaxData.
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

  /// Copies the coordinates and the data; null data means zeros. Returns false if a coordinate is
  /// NaN.
  bool add(const float* place, const void* data);
  /// At most `most` points within `radius`, nearest first; points at equal distance in insertion
  /// order.
  std::vector<Near> near(const float* place, float radius, std::size_t most) const;
  /// All points in insertion order.
  std::vector<Point> all() const;

  std::size_t bytes() const;

 private:
  using Index = std::uint32_t;
  /// Implicit kd-tree: the median of a range splits it along a coordinate that depends on the
  /// depth.
  using Level = std::vector<Index>;
  struct Search;

  Point point(Index i) const;
  void arrange(std::span<Index> range, int axis) const;
  void visit(std::span<const Index> range, int axis, Search& search) const;

  const std::size_t dimensions_, data_size_, stride_;
  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<std::byte[]>> points_;  ///< coordinates, then data
  std::vector<Level> levels_;                         ///< level k has 2^k points or none
};

}  // namespace oriel::geom
