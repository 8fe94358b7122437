// SPDX-License-Identifier: Apache-2.0
#include "geom/point_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <utility>

namespace oriel::geom {
namespace {

constexpr std::size_t kAlign = alignof(std::max_align_t);

std::size_t begin_of_data(std::size_t dimensions) {
  return (dimensions * sizeof(float) + kAlign - 1) / kAlign * kAlign;
}

}  // namespace

/// The nearest points found so far, as a max-heap by distance.
struct PointTree::Search {
  const float* place;
  double reach2;  ///< square of the search radius
  std::size_t most;
  std::vector<std::pair<double, Index>> found;

  void add(double distance2, Index i) {
    if (!(distance2 <= reach2)) return;
    found.emplace_back(distance2, i);
    std::push_heap(found.begin(), found.end());
    if (found.size() <= most) return;
    std::pop_heap(found.begin(), found.end());
    found.pop_back();
    reach2 = std::min(reach2, found.front().first);
  }
};

PointTree::PointTree(int dimensions, std::size_t data_size)
    : dimensions_(static_cast<std::size_t>(std::clamp(dimensions, 1, kMaxDimensions))),
      data_size_(std::min(data_size, kMaxData)),
      stride_(begin_of_data(dimensions_) + data_size_) {}

PointTree::Point PointTree::point(Index i) const {
  std::byte* block = points_[i].get();
  return {reinterpret_cast<const float*>(block), block + begin_of_data(dimensions_)};
}

void PointTree::arrange(std::span<Index> range, int axis) const {
  if (range.size() < 2) return;
  const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
  std::nth_element(range.begin(), middle, range.end(), [&](Index a, Index b) {
    return std::pair(point(a).place[axis], a) < std::pair(point(b).place[axis], b);
  });
  const int next = (axis + 1) % static_cast<int>(dimensions_);
  const std::size_t half = range.size() / 2;
  arrange(range.first(half), next);
  arrange(range.subspan(half + 1), next);
}

bool PointTree::add(const float* place, const void* data) {
  for (std::size_t k = 0; k < dimensions_; ++k)
    if (!std::isfinite(place[k])) return false;
  auto block = std::make_unique<std::byte[]>(stride_);
  std::memcpy(block.get(), place, dimensions_ * sizeof(float));
  if (data && data_size_ > 0)
    std::memcpy(block.get() + begin_of_data(dimensions_), data, data_size_);

  const std::unique_lock lock(mutex_);
  if (points_.size() >= std::numeric_limits<Index>::max()) return false;
  Level merged = {static_cast<Index>(points_.size())};
  points_.push_back(std::move(block));
  std::size_t k = 0;
  for (; k < levels_.size() && !levels_[k].empty(); ++k) {
    merged.insert(merged.end(), levels_[k].begin(), levels_[k].end());
    levels_[k] = {};
  }
  if (k == levels_.size()) levels_.emplace_back();
  arrange(merged, 0);
  levels_[k] = std::move(merged);
  return true;
}

void PointTree::visit(std::span<const Index> range, int axis, Search& search) const {
  if (range.empty()) return;
  const std::size_t half = range.size() / 2;
  const float* here = point(range[half]).place;
  double distance2 = 0;
  for (std::size_t k = 0; k < dimensions_; ++k) {
    const double d = static_cast<double>(search.place[k]) - here[k];
    distance2 += d * d;
  }
  search.add(distance2, range[half]);
  const double across = static_cast<double>(search.place[axis]) - here[axis];
  const auto below = range.first(half), above = range.subspan(half + 1);
  const int next = (axis + 1) % static_cast<int>(dimensions_);
  visit(across < 0 ? below : above, next, search);
  if (across * across <= search.reach2) visit(across < 0 ? above : below, next, search);
}

std::vector<PointTree::Near> PointTree::near(const float* place, float radius,
                                             std::size_t most) const {
  if (most == 0 || !(radius >= 0)) return {};
  const std::shared_lock lock(mutex_);
  Search search{place, static_cast<double>(radius) * radius, most, {}};
  for (const Level& level : levels_) visit(level, 0, search);
  std::sort_heap(search.found.begin(), search.found.end());
  std::vector<Near> result;
  result.reserve(search.found.size());
  for (const auto& [distance2, i] : search.found)
    result.push_back({point(i), static_cast<float>(std::sqrt(distance2))});
  return result;
}

std::vector<PointTree::Point> PointTree::all() const {
  const std::shared_lock lock(mutex_);
  std::vector<Point> result;
  result.reserve(points_.size());
  for (Index i = 0; i < points_.size(); ++i) result.push_back(point(i));
  return result;
}

std::size_t PointTree::bytes() const {
  const std::shared_lock lock(mutex_);
  return points_.size() * (stride_ + 2 * sizeof(Index));
}

}  // namespace oriel::geom
