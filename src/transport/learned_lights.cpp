// SPDX-License-Identifier: Apache-2.0
#include "transport/learned_lights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel {
namespace {

/// What the node above counts, in points. A guess.
constexpr float kLightsAbove = 0.5f;
/// Shares of the light tree that are compared.
constexpr std::array kShares{0.3f, 0.5f, 0.75f, 1.0f};

/// Of a node: mean squares of the lights, and how noisy each of kShares is there.
struct LightsOfNode {
  std::vector<float> squares;
  std::array<float, kShares.size()> noise{};
};

/// Computes nodes from what was measured at the points.
class LightStatistics {
 public:
  LightStatistics(std::size_t lights, std::span<const float> squares,
                  std::span<const float> by_tree)
      : count_(lights), squares_(squares), by_tree_(by_tree) {}

  LightsOfNode mean(std::span<const std::uint32_t> points, const LightsOfNode& above) const {
    LightsOfNode node{sums(points, above.squares), {}};
    for (std::size_t i = 0; i < kShares.size(); ++i) node.noise[i] = kLightsAbove * above.noise[i];
    for (const std::uint32_t point : points) add_noise(point, node.squares, node.noise);
    const float scale = 1 / (static_cast<float>(points.size()) + kLightsAbove);
    for (float& square : node.squares) square *= scale;
    for (float& noise : node.noise) noise *= scale;
    return node;
  }

 private:
  std::vector<float> sums(std::span<const std::uint32_t> points,
                          const std::vector<float>& above) const {
    std::vector<float> sum(count_);
    for (std::size_t k = 0; k < count_; ++k) sum[k] = kLightsAbove * above[k];
    for (const std::uint32_t point : points)
      for (std::size_t k = 0; k < count_; ++k) sum[k] += squares_[point * count_ + k];
    return sum;
  }

  /// Adds the mean square of estimates at a point by each share, relative to the tree alone. The
  /// probabilities are those of all other points of the node.
  void add_noise(std::uint32_t point, const std::vector<float>& sums,
                 std::array<float, kShares.size()>& noise) const {
    const auto squares = squares_.subspan(point * count_, count_);
    const auto by_tree = by_tree_.subspan(point * count_, count_);
    const auto chance = [&](std::size_t k) {
      return std::sqrt(std::max(0.0, static_cast<double>(sums[k]) - squares[k]));
    };
    double all = 0;
    for (std::size_t k = 0; k < count_; ++k) all += chance(k);
    double alone = 0;
    std::array<double, kShares.size()> sum{};
    for (std::size_t k = 0; k < count_; ++k) {
      if (!(squares[k] > 0)) continue;
      alone += squares[k] / double{by_tree[k]};
      const double learned = all > 0 ? chance(k) / all : 0;
      for (std::size_t i = 0; i < kShares.size(); ++i)
        sum[i] += squares[k] / (learned + kShares[i] * (by_tree[k] - learned));
    }
    if (!(alone > 0)) return;
    for (std::size_t i = 0; i < kShares.size(); ++i) noise[i] += static_cast<float>(sum[i] / alone);
  }

  std::size_t count_;
  std::span<const float> squares_, by_tree_;
};

}  // namespace

LearnedLights::LearnedLights(std::span<const SurfaceTree::Point> points,
                             std::span<const float> squares, std::span<const float> by_tree) {
  if (points.empty() || squares.empty()) return;
  count_ = squares.size() / points.size();
  tree_ = SurfaceTree(points);
  const LightStatistics statistics(count_, squares, by_tree);
  const auto mean = [&](std::span<const std::uint32_t> indices, const LightsOfNode& above) {
    return statistics.mean(indices, above);
  };
  for (const LightsOfNode& cell :
       tree_.values(LightsOfNode{std::vector<float>(count_), {}}, mean)) {
    double sum = 0;  // double: shares must add up to 1
    for (const float square : cell.squares) sum += std::sqrt(static_cast<double>(square));
    double until = 0;
    for (const float square : cell.squares) {
      const double share = sum > 0 ? std::sqrt(static_cast<double>(square)) / sum : 0;
      probability_.push_back(static_cast<float>(share));
      until_.push_back(static_cast<float>(until += share));
    }
    const auto least = std::min_element(cell.noise.begin(), cell.noise.end());
    unlearned_.push_back(sum > 0 ? kShares[static_cast<std::size_t>(least - cell.noise.begin())]
                                 : 1.0f);
  }
  tree_.forget_points();
}

bool LearnedLights::is_valid(std::size_t lights) const {
  if (count_ == 0) return probability_.empty() && until_.empty() && unlearned_.empty();
  constexpr float kMost = 1.0001f;
  const auto is_share = [](float value) { return value >= 0 && value <= kMost; };
  if (count_ != lights || tree_.empty() || !tree_.is_valid() ||
      probability_.size() / count_ != tree_.cells() || probability_.size() % count_ != 0 ||
      until_.size() != probability_.size() || unlearned_.size() != tree_.cells() ||
      !std::all_of(probability_.begin(), probability_.end(), is_share) ||
      !std::all_of(until_.begin(), until_.end(), is_share) ||
      !std::all_of(unlearned_.begin(), unlearned_.end(),
                   [](float share) { return share >= kShares.front() && share <= 1; }))
    return false;
  for (std::size_t row = 0; row < until_.size(); row += count_)
    if (!std::is_sorted(&until_[row], &until_[row] + count_)) return false;
  return true;
}

}  // namespace oriel
