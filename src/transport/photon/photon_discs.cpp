// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_discs.h"

#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace oriel {

PhotonDiscs::PhotonDiscs(std::vector<Photon> photons, float merge, int count, float radius)
    : radius_(radius) {
  const PhotonMap all(std::move(photons), merge);
  std::vector<std::size_t> sizes(all.size());
  constexpr std::size_t kBlock = 256;
  parallel_for_blocks(all.size(), kBlock, [&](std::size_t i) {
    const Photon& photon = all.photons()[i];
    const float own =
        all.radius(photon.position, photon.normal, {.count = count, .radius = radius});
    float size = radius;
    while (sizes[i] + 1 < kSizes && size > own) size /= 2, ++sizes[i];
  });
  std::array<std::vector<Photon>, kSizes> by_size;
  for (std::size_t i = 0; i < all.size(); ++i) by_size[sizes[i]].push_back(all.photons()[i]);
  for (std::size_t k = 0; k < kSizes; ++k) maps_[k] = PhotonMap(std::move(by_size[k]));
}

std::size_t PhotonDiscs::bytes() const {
  std::size_t bytes = 0;
  for (const PhotonMap& map : maps_) bytes += map.bytes();
  return bytes;
}

Rgb PhotonDiscs::irradiance(const Vec3& position, const Vec3& normal, PhotonLookup lookup,
                            Rgb* by_light, std::size_t unknown, int* found) const {
  lookup.count = PhotonMap::kMaxCount;
  lookup.radius = radius_;
  Rgb sum(0);
  for (const PhotonMap& map : maps_) {
    sum += map.irradiance(position, normal, lookup, by_light, unknown, found);
    lookup.radius /= 2;
  }
  return sum;
}

bool PhotonDiscs::is_valid() const {
  return std::isfinite(radius_) && radius_ >= 0 &&
         std::all_of(maps_.begin(), maps_.end(), [](const PhotonMap& m) { return m.is_valid(); });
}

}  // namespace oriel
