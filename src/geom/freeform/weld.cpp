// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/weld.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace oriel::geom::freeform {
namespace {

/// Hash grid of points with the weld distance as cell size.
class PlaceTable {
 public:
  explicit PlaceTable(double distance) : distance_(distance) {}

  /// A stored point within the distance, or p, which is then stored.
  Vec3 find(const Vec3& p) {
    const auto cell = [this](float x) {
      return static_cast<std::int64_t>(std::floor(x / distance_));
    };
    const std::int64_t x = cell(p.x), y = cell(p.y), z = cell(p.z);
    for (std::int64_t i = x - 1; i <= x + 1; ++i)
      for (std::int64_t j = y - 1; j <= y + 1; ++j)
        for (std::int64_t k = z - 1; k <= z + 1; ++k) {
          const auto [begin, end] = places_.equal_range(key(i, j, k));
          for (auto it = begin; it != end; ++it)
            if (length(it->second - p) <= static_cast<float>(distance_)) return it->second;
        }
    places_.emplace(key(x, y, z), p);
    return p;
  }

 private:
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    // Primes of M. Teschner et al., "Optimized spatial hashing for collision detection", 2003.
    return static_cast<std::uint64_t>(i) * 73856093u ^ static_cast<std::uint64_t>(j) * 19349663u ^
           static_cast<std::uint64_t>(k) * 83492791u;
  }
  double distance_;
  std::unordered_multimap<std::uint64_t, Vec3> places_;
};

}  // namespace

void weld_edges(std::vector<SurfacePart>& parts, float distance) {
  Box3 box;
  for (const SurfacePart& part : parts)
    for (const std::uint32_t v : part.edge) box.extendBy(part.mesh.positions[v]);
  if (box.isEmpty()) return;
  const Vec3 farthest(std::max(-box.min.x, box.max.x), std::max(-box.min.y, box.max.y),
                      std::max(-box.min.z, box.max.z));
  constexpr float kRounding = 2e-6f;  // some units in the last place of the largest coordinate
  const float least = kRounding * std::max(length(box.size()), length(farthest));
  if (!(least > 0)) return;
  PlaceTable table(std::max(distance, least));
  for (SurfacePart& part : parts)
    for (const std::uint32_t v : part.edge)
      part.mesh.positions[v] = table.find(part.mesh.positions[v]);
}

}  // namespace oriel::geom::freeform
