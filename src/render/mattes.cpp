// SPDX-License-Identifier: Apache-2.0
#include "render/mattes.h"

#include <algorithm>
#include <utility>

namespace oriel {

Mattes::Mattes(int width, int height, const FilterSampler& filter, MatteNames names)
    : width_(width),
      plain_share_(filter.positive_share()),
      marked_share_(filter.negative_share()),
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
    (negative ? at->marked : at->plain) += 1 / static_cast<float>(seen.size());
  }
}

void Mattes::clear() {
  for (std::vector<Entry>& entries : pixels_) entries.clear();
}

std::vector<Mattes::Share> Mattes::shares(int x, int y) const {
  const std::vector<Entry>& entries =
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)];
  float plain = 0, marked = 0;
  for (const Entry& e : entries) plain += e.plain, marked += e.marked;
  // Until both kinds of samples have been drawn one stands for the other.
  const float of_plain = plain == 0 ? 0 : (marked > 0 ? plain_share_ : 1.0f) / plain;
  const float of_marked = marked == 0 ? 0 : (plain > 0 ? -marked_share_ : 1.0f) / marked;
  std::vector<Share> shares;
  shares.reserve(entries.size());
  float sum = 0;
  for (const Entry& e : entries) {
    const float coverage = std::max(e.plain * of_plain + e.marked * of_marked, 0.0f);
    if (coverage > 0) shares.push_back({e.seen, coverage});
    sum += coverage;
  }
  for (Share& share : shares) share.coverage /= sum;
  return shares;
}

}  // namespace oriel
