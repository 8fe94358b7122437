// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_merge.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sampling/sampler.h"

namespace oriel {
namespace {

/// Double: thousands of small powers may add up in one.
using Sum = Imath::Vec3<double>;

struct MergedPhoton {
  Photon first;
  Sum position{0.0}, direction{0.0}, power{0.0};
  double weight = 0;
  int next = -1;  ///< in the same cell
};

struct Cell {
  std::int64_t x, y, z;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    using sampling::mix_bits;
    const auto bits = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
    return mix_bits(mix_bits(mix_bits(bits(c.x)) + bits(c.y)) + bits(c.z));
  }
};

/// Far out cells are the same: coordinates that large resolve no such distance anyway.
std::int64_t cell_of(float x, float distance) {
  constexpr double kMax = 1e15;
  const double cell = std::floor(static_cast<double>(x) / static_cast<double>(distance));
  return static_cast<std::int64_t>(std::fmin(std::fmax(cell, -kMax), kMax));
}

}  // namespace

std::vector<Photon> merge_photons(const std::vector<Photon>& photons, float distance,
                                  float agreement) {
  std::vector<MergedPhoton> kept;
  std::unordered_map<Cell, int, CellHash> cells;
  for (const Photon& photon : photons) {
    const Cell cell{cell_of(photon.position.x, distance), cell_of(photon.position.y, distance),
                    cell_of(photon.position.z, distance)};
    // The cells are as wide as the distance: the next ones around hold all that may be near.
    int nearest = -1;
    float nearest2 = sqr(distance);
    for (int i = 0; i < 27; ++i) {
      const auto found =
          cells.find({cell.x + i % 3 - 1, cell.y + i / 3 % 3 - 1, cell.z + i / 9 - 1});
      for (int k = found == cells.end() ? -1 : found->second; k >= 0;
           k = kept[static_cast<std::size_t>(k)].next) {
        const Photon& other = kept[static_cast<std::size_t>(k)].first;
        const Vec3 d = other.position - photon.position;
        if (dot(d, d) >= nearest2 || dot(other.normal, photon.normal) < agreement ||
            other.layer != photon.layer)
          continue;
        nearest2 = dot(d, d);
        nearest = k;
      }
    }
    if (nearest < 0) {
      nearest = static_cast<int>(kept.size());
      kept.push_back({.first = photon});
      const auto [place, is_new] = cells.try_emplace(cell, nearest);
      if (!is_new) {
        kept.back().next = place->second;
        place->second = nearest;
      }
    }
    MergedPhoton& k = kept[static_cast<std::size_t>(nearest)];
    const double weight = std::fmax(1e-30, static_cast<double>(max_component(photon.power)));
    k.position += Sum(photon.position) * weight;
    k.direction += Sum(photon.direction) * weight;
    k.power += Sum(photon.power.x, photon.power.y, photon.power.z);
    k.weight += weight;
  }
  std::vector<Photon> merged;
  merged.reserve(kept.size());
  for (const MergedPhoton& k : kept) {
    Photon photon = k.first;
    photon.position = Vec3(k.position / k.weight);
    const Vec3 direction(k.direction / k.weight);
    if (length(direction) > 0) photon.direction = normalize(direction);
    photon.power = Rgb(Vec3(k.power));
    merged.push_back(photon);
  }
  return merged;
}

}  // namespace oriel
