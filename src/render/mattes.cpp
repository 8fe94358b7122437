// SPDX-License-Identifier: Apache-2.0
#include "render/mattes.h"

#include <algorithm>
#include <utility>

namespace oriel {

Mattes::Mattes(int width, int height, const FilterSampler& filter, MatteNames names)
    : width_(width),
      positive_share_(filter.positive_share()),
      negative_share_(filter.negative_share()),
      names_(std::move(names)),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Mattes::add(int x, int y, std::span<const FirstSurface> seen, bool negative) {
  std::vector<Entry>& entries =
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)];
  for (const FirstSurface& surface : seen) {
    auto at = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) {
      return e.seen.instance == surface.instance && e.seen.material == surface.material;
    });
    if (at == entries.end()) at = entries.insert(entries.end(), {surface, 0, 0});
    // Where a sample is several rays, each is a part of it.
    (negative ? at->negative : at->positive) += 1 / static_cast<float>(seen.size());
  }
}

void Mattes::clear() {
  for (std::vector<Entry>& entries : pixels_) entries.clear();
}

std::vector<Mattes::Share> Mattes::shares(int x, int y) const {
  const std::vector<Entry>& entries =
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)];
  float positive = 0, negative = 0;
  for (const Entry& e : entries) positive += e.positive, negative += e.negative;
  // Until both kinds of samples have been drawn one stands for the other.
  const float of_plain = positive == 0 ? 0 : (negative > 0 ? positive_share_ : 1.0f) / positive;
  const float of_marked = negative == 0 ? 0 : (positive > 0 ? -negative_share_ : 1.0f) / negative;
  std::vector<Share> shares;
  shares.reserve(entries.size());
  float sum = 0;
  for (const Entry& e : entries) {
    const float coverage = std::max(e.positive * of_plain + e.negative * of_marked, 0.0f);
    if (coverage > 0) shares.push_back({e.seen, coverage});
    sum += coverage;
  }
  for (Share& share : shares) share.coverage /= sum;
  return shares;
}

}  // namespace oriel
