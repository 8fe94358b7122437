// SPDX-License-Identifier: Apache-2.0
#include "lights/mesh_lights.h"

#include <algorithm>
#include <numeric>

namespace oriel {
namespace {

/// Halves of ranges by the middle of their box, so that what lies apart comes apart; then, where
/// that does not go on, by number.
constexpr int kDeepestByPlace = 48;

/// Puts neighbours together: ranges of at most `most`, whose starts are noted.
class Clustering {
 public:
  Clustering(std::span<const LightBounds> bounds, std::size_t most) : bounds_(bounds), most_(most) {
    order.resize(bounds.size());
    std::iota(order.begin(), order.end(), 0u);
    divide(0, order.size(), 0);
    starts.push_back(static_cast<std::uint32_t>(order.size()));
  }
  std::vector<std::uint32_t> order, starts;

 private:
  Vec3 centre(std::uint32_t i) const { return bounds_[i].box.center(); }

  void divide(std::size_t begin, std::size_t end, int depth) {
    if (end - begin <= most_) {
      starts.push_back(static_cast<std::uint32_t>(begin));
      return;
    }
    geom::Box3 box;
    for (std::size_t i = begin; i < end; ++i) box.extendBy(centre(order[i]));
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin),
               last = order.begin() + static_cast<std::ptrdiff_t>(end);
    auto middle = first;
    if (depth < kDeepestByPlace) {
      const float half = box.center()[axis];
      middle = std::stable_partition(first, last,
                                     [&](std::uint32_t i) { return centre(i)[axis] < half; });
    }
    if (middle == first || middle == last) middle = first + (last - first) / 2;
    const auto cut = static_cast<std::size_t>(middle - order.begin());
    divide(begin, cut, depth + 1);
    divide(cut, end, depth + 1);
  }

  std::span<const LightBounds> bounds_;
  std::size_t most_;
};

}  // namespace

MeshLights::MeshLights(std::vector<EmissiveTriangle> triangles, std::span<const LightBounds> bounds,
                       std::span<const std::uint32_t> triangles_of_instance) {
  if (triangles.empty()) return;
  // Halving fills clusters by a half and more.
  const std::size_t most =
      triangles.size() <= kMaxClusters ? 1 : 2 * triangles.size() / kMaxClusters + 1;
  Clustering clusters(bounds, most);
  starts_ = std::move(clusters.starts);
  first_.assign(triangles_of_instance.size(), kNone);
  std::uint32_t numbers = 0;
  for (std::size_t i = 0; i < first_.size(); ++i)
    if (triangles_of_instance[i] > 0) {
      first_[i] = numbers;
      numbers += triangles_of_instance[i];
    }
  number_of_.assign(numbers, kNone);
  shares_.reserve(triangles.size());
  std::vector<LightBounds> whole(starts_.size() - 1);
  for (std::size_t c = 0; c + 1 < starts_.size(); ++c) {
    double power = 0;  // double: thousands of terms
    for (std::uint32_t k = starts_[c]; k < starts_[c + 1]; ++k) {
      const std::uint32_t i = clusters.order[k];
      whole[c] = k == starts_[c] ? bounds[i] : joined(whole[c], bounds[i]);
      power += static_cast<double>(triangles[i].power);
    }
    double sum = 0;
    for (std::uint32_t k = starts_[c]; k < starts_[c + 1]; ++k) {
      const EmissiveTriangle& t = triangles[clusters.order[k]];
      sum += static_cast<double>(t.power);
      number_of_[first_[t.instance] + t.primitive] = static_cast<std::uint32_t>(shares_.size());
      shares_.push_back({t.instance, t.primitive, static_cast<float>(sum / power)});
    }
    shares_.back().until = 1;
  }
  std::vector<int> names(whole.size());
  std::iota(names.begin(), names.end(), 0);
  tree_ = LightTree(whole, names);
  parts_ = tree_.parts(kMaxParts);
  part_of_.resize(whole.size());
  for (std::size_t p = 0; p < parts_.size(); ++p)
    tree_.for_each_light(parts_[p], [&](int cluster) {
      part_of_[static_cast<std::size_t>(cluster)] = static_cast<std::uint8_t>(p);
    });
}

float MeshLights::share_of(std::size_t triangle, std::size_t cluster) const {
  return shares_[triangle].until - (triangle > starts_[cluster] ? shares_[triangle - 1].until : 0);
}

MeshLights::Choice MeshLights::in_cluster(const LightTree::Choice& found, float u) const {
  const auto cluster = static_cast<std::size_t>(found.light);
  const auto begin = shares_.begin() + starts_[cluster],
             end = shares_.begin() + starts_[cluster + 1];
  const auto at = std::find_if(begin, end - 1, [&](const Share& share) { return u < share.until; });
  const auto triangle = static_cast<std::size_t>(at - shares_.begin());
  return {at->instance, at->primitive, found.probability * share_of(triangle, cluster)};
}

std::optional<MeshLights::Choice> MeshLights::choose_of(std::size_t part, const LitPoint& lit,
                                                        Vec2 u) const {
  const auto found = tree_.choose(lit, u.x, parts_[part]);
  if (!found) return std::nullopt;
  return in_cluster(*found, u.y);
}

std::optional<MeshLights::Choice> MeshLights::choose(const LitPoint& lit,
                                                     const LightChances& chances, Vec2 u) const {
  LightTree::Part from = LightTree::kWhole;
  if (chances && !chances.ignored(u.x)) from = parts_[chances.choose(u.x)];
  auto found = tree_.choose(lit, u.x, from);
  if (!found) return std::nullopt;
  if (chances) {
    // What is above the part was chosen by the tree or by the chances.
    const std::size_t part = part_of_[static_cast<std::size_t>(found->light)];
    const float by_tree = probability_of(part, lit);
    if (from == LightTree::kWhole) found->probability /= by_tree;
    found->probability *= chances.mixed(part, by_tree);
  }
  return in_cluster(*found, u.y);
}

float MeshLights::probability_of_cluster(const LitPoint& lit, const LightChances& chances,
                                         int cluster) const {
  if (!chances) return tree_.probability(lit, cluster);
  const std::size_t part = part_of_[static_cast<std::size_t>(cluster)];
  return chances.mixed(part, probability_of(part, lit)) *
         tree_.probability_of(lit, ~cluster, parts_[part]);
}

float MeshLights::probability(const LitPoint& lit, const LightChances& chances,
                              std::uint32_t instance, std::uint32_t primitive) const {
  if (instance >= first_.size() || first_[instance] == kNone) return 0;
  const std::uint32_t triangle = number_of_[first_[instance] + primitive];
  if (triangle == kNone) return 0;
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), triangle);
  const auto cluster = static_cast<std::size_t>(after - starts_.begin()) - 1;
  return probability_of_cluster(lit, chances, static_cast<int>(cluster)) *
         share_of(triangle, cluster);
}

}  // namespace oriel
