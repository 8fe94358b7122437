// SPDX-License-Identifier: Apache-2.0
#include "transport/learned_lights.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

/// What the node above counts, in points. A guess.
constexpr float kLightsAbove = 0.5f;

}  // namespace

LearnedLights::LearnedLights(const geom::Box3& bounds, std::span<const SurfaceTree::Point> points,
                             std::span<const float> squares) {
  if (points.empty() || squares.empty()) return;
  count_ = squares.size() / points.size();
  tree_ = SurfaceTree(bounds, points);
  using Row = std::vector<float>;
  const auto mean = [&](std::span<const std::uint32_t> indices, const Row& above) {
    Row row(count_);
    for (std::size_t k = 0; k < count_; ++k) row[k] = kLightsAbove * above[k];
    for (const std::uint32_t i : indices)
      for (std::size_t k = 0; k < count_; ++k) row[k] += squares[i * count_ + k];
    const float scale = 1 / (static_cast<float>(indices.size()) + kLightsAbove);
    for (float& value : row) value *= scale;
    return row;
  };
  for (const Row& row : tree_.values(Row(count_, 0.0f), mean)) {
    double sum = 0;  // double: shares must add up to 1
    for (const float square : row) sum += std::sqrt(static_cast<double>(square));
    double until = 0;
    for (const float square : row) {
      const double share = sum > 0 ? std::sqrt(static_cast<double>(square)) / sum : 0;
      probability_.push_back(static_cast<float>(share));
      until_.push_back(static_cast<float>(until += share));
    }
  }
  tree_.forget_points();
}

bool LearnedLights::is_valid(std::size_t lights) const {
  if (count_ == 0) return probability_.empty() && until_.empty();
  constexpr float kMost = 1.0001f;
  const auto is_share = [](float value) { return value >= 0 && value <= kMost; };
  if (count_ != lights || tree_.empty() || !tree_.is_valid() ||
      probability_.size() / count_ != tree_.cells() || probability_.size() % count_ != 0 ||
      until_.size() != probability_.size() ||
      !std::all_of(probability_.begin(), probability_.end(), is_share) ||
      !std::all_of(until_.begin(), until_.end(), is_share))
    return false;
  for (std::size_t row = 0; row < until_.size(); row += count_)
    if (!std::is_sorted(&until_[row], &until_[row] + count_)) return false;
  return true;
}

}  // namespace oriel
