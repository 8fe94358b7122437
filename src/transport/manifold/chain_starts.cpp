// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/chain_starts.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sampling/sampler.h"

namespace oriel {
namespace {

/// Photons of a cell from which on it is used in place of a larger one.
constexpr std::size_t kEnough = 8;
/// Photons of a cell that may give starts, and photons in sequence whose chains must be found for
/// the others to be skipped.
constexpr std::size_t kMostPhotons = 64, kConvinced = 12;
constexpr int kCoordinateBits = 20;
/// Number of rays of one pass over all starts up to which every vertex searches.
constexpr float kCheap = 6;
/// Share of the light from which on every vertex searches. An estimate: errors of photon maps are
/// about a tenth of their light, so less is hardly visible.
constexpr float kVisible = 0.25f;
/// Least factors of the chance by rays and by light.
constexpr float kLeastChance = 0.125f;

struct Order {
  std::uint64_t key;
  std::uint32_t photon;
  bool operator<(const Order& o) const { return key != o.key ? key < o.key : photon < o.photon; }
};

/// Concentration of a chain over the mean of its cell up to which the search is used. At a fold
/// of a caustic, whose irradiance grows as 1 / sqrt(distance), the rest is a thousandth of the
/// width of a cell.
constexpr float kSpike = 32;

struct Chosen {
  std::vector<ChainStart> starts;
  float limit = 0;
  float chance = 0;
};

/// The starts of the photons of one cell.
Chosen choose_starts(std::span<const Order> cell, const std::vector<const ChainPhoton*>& photons,
                     const ChainStarts::Finds& finds, RayCounts& counts) {
  Chosen chosen;
  std::vector<ChainStart>& starts = chosen.starts;
  // Photons are as dense as their chains are concentrated, so the harmonic mean over photons is the
  // mean over places.
  float inverse = 0, known = 0;
  const auto take = [&](float concentration) {
    if (!(concentration > 0)) return false;
    inverse += 1 / concentration;
    ++known;
    return true;
  };
  std::size_t in_sequence = 0;
  for (const Order& o : cell.first(std::min(cell.size(), kMostPhotons))) {
    const ChainPhoton& p = *photons[o.photon];
    if (take(finds(starts, p, counts))) {
      if (++in_sequence == kConvinced) break;
      continue;
    }
    in_sequence = 0;
    const ChainStart own{p.chain.kind, p.chain.last};
    if (!take(finds({&own, 1}, p, counts))) continue;
    starts.push_back(own);
    if (starts.size() == ChainStarts::kMostStarts) break;
  }
  if (known > 0) chosen.limit = kSpike * known / inverse;
  return chosen;
}

float chance_by_rays(const std::vector<ChainStart>& starts) {
  float rays = 0;
  for (const ChainStart& start : starts) rays += static_cast<float>(start.kind.count) + 1;
  return clamp(kCheap / rays, kLeastChance, 1);
}

/// Irradiance of a surface across a cell.
float irradiance_of(std::span<const Order> cell, const std::vector<const ChainPhoton*>& photons,
                    float size) {
  float power = 0;
  for (const Order& o : cell) power += max_component(photons[o.photon]->photon.power);
  return power / sqr(size);
}

}  // namespace

ChainStarts::ChainStarts(const std::vector<const ChainPhoton*>& photons, const Finds& finds,
                         const ShareOfLight& share_of_light, const Vec3& low, float size,
                         RayCounts& counts, const ProgressMonitor& monitor)
    : low_(low), size_(size) {
  std::vector<Order> order(photons.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i].photon = static_cast<std::uint32_t>(i);
  for (int level = 0; level < kLevels && !monitor.cancelled(); ++level) {
    for (Order& o : order) o.key = key_of(photons[o.photon]->photon.position, level);
    std::sort(order.begin(), order.end());
    std::vector<std::span<const Order>> cells;
    std::vector<Order> left;  // photons without a cell
    for (std::size_t i = 0; i < order.size();) {
      std::size_t end = i + 1;
      while (end < order.size() && order[end].key == order[i].key) ++end;
      const std::span<const Order> cell(order.data() + i, end - i);
      if (cell.size() >= kEnough || level == kLevels - 1)
        cells.push_back(cell);
      else
        left.insert(left.end(), cell.begin(), cell.end());
      i = end;
    }
    std::vector<Chosen> chosen(cells.size());
    std::vector<RayCounts> traced(cells.size());
    parallel_for(cells.size(), [&](std::size_t i) {
      if (monitor.cancelled()) return;
      chosen[i] = choose_starts(cells[i], photons, finds, traced[i]);
      if (chosen[i].starts.empty()) return;
      const float irradiance =
          irradiance_of(cells[i], photons, size * static_cast<float>(1 << level));
      const float share = share_of_light(*photons[cells[i].front().photon], irradiance, traced[i]);
      chosen[i].chance =
          chance_by_rays(chosen[i].starts) * clamp(share / kVisible, kLeastChance, 1);
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
      counts += traced[i];
      const Chosen& c = chosen[i];
      cells_.push_back({cells[i].front().key, static_cast<std::uint32_t>(starts_.size()),
                        static_cast<std::uint16_t>(c.starts.size()),
                        static_cast<std::uint16_t>(std::ceil(c.chance * kCertain)), c.limit});
      starts_.insert(starts_.end(), c.starts.begin(), c.starts.end());
    }
    monitor.report("caustics", 0.5 * (level + 1) / kLevels);
    order = std::move(left);
  }
  make_table();
}

std::uint64_t ChainStarts::key_of(const Vec3& position, int level) const {
  std::uint64_t key = static_cast<std::uint64_t>(level);
  const float cell = size_ * static_cast<float>(1 << level);
  for (int k = 0; k < 3; ++k) {
    constexpr float kMost = (1 << kCoordinateBits) - 1;
    key = key << kCoordinateBits |
          static_cast<std::uint64_t>(clamp((position[k] - low_[k]) / cell, 0, kMost));
  }
  return key;
}

void ChainStarts::make_table() {
  std::size_t size = 1;
  while (size < 2 * cells_.size()) size *= 2;
  table_.assign(size, 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::size_t slot = sampling::mix_bits(cells_[i].key) & (size - 1);
    while (table_[slot] != 0) slot = (slot + 1) & (size - 1);
    table_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

const ChainStarts::Cell* ChainStarts::find(std::uint64_t key) const {
  for (std::size_t slot = sampling::mix_bits(key) & (table_.size() - 1);;
       slot = (slot + 1) & (table_.size() - 1)) {
    if (table_[slot] == 0) return nullptr;
    const Cell& cell = cells_[table_[slot] - 1];
    if (cell.key == key) return &cell;
  }
}

ChainStarts::Found ChainStarts::at(const Vec3& position) const {
  if (starts_.empty()) return {};
  for (int level = 0; level < kLevels; ++level)
    if (const Cell* cell = find(key_of(position, level)))
      return {{starts_.data() + cell->first, cell->count},
              static_cast<float>(cell->chance) / kCertain,
              cell->limit};
  return {};
}

bool ChainStarts::is_valid(std::size_t lights, std::size_t instances) const {
  if (!is_finite(low_) || !(size_ > 0)) return false;
  for (const Cell& cell : cells_)
    if (cell.first > starts_.size() || cell.count > starts_.size() - cell.first ||
        cell.count > kMostStarts || (cell.count > 0) != (cell.chance > 0))
      return false;
  for (const ChainStart& start : starts_) {
    const ChainKind& kind = start.kind;
    if (kind.light < 0 || static_cast<std::size_t>(kind.light) >= lights) return false;
    if (kind.count < 1 || kind.count > ChainKind::kMost || !is_finite(start.towards)) return false;
    for (int i = 0; i < kind.count; ++i)
      if (kind.instance[i] < 0 || static_cast<std::size_t>(kind.instance[i]) >= instances ||
          !(kind.eta[i] > 0))
        return false;
  }
  return true;
}

}  // namespace oriel
