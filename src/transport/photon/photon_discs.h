// SPDX-License-Identifier: Apache-2.0
// Photons that each light a disc of their own size.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "transport/photon/photon_map.h"

namespace oriel {

/// Photons that each light a disc of their own size, for photons that lie in lines and clusters.
/// The estimates of PhotonMap, by the nearest photons, are too bright there: around a line of
/// photons they add up to twice its power.
///
/// Model:   the disc of a photon reaches to its `count`-th neighbour, at most to `radius`. Its size
///          is rounded down to `radius` divided by a power of two up to 2^(kSizes - 1); smaller
///          discs get this smallest size. The photons of each size are a map that is read with a
///          fixed radius. On an unbounded plane the light of the discs adds up to the power of the
///          photons. Immutable, so any thread may ask.
/// Source:  I. Abramson, "On Bandwidth Variation in Kernel Estimates", Annals of Statistics 10(4),
///          1982 (a kernel for each sample).
/// Checked: PhotonDiscs.* in photon_discs_test.cpp.
class PhotonDiscs {
 public:
  static constexpr std::size_t kSizes = 6;

  PhotonDiscs() = default;
  /// Inputs:  photons, merge: as those of PhotonMap; radius: scene units, above 0.
  PhotonDiscs(std::vector<Photon> photons, float merge, int count, float radius);

  bool empty() const {
    return std::all_of(maps_.begin(), maps_.end(), [](const PhotonMap& m) { return m.empty(); });
  }
  std::size_t bytes() const;

  /// As PhotonMap::irradiance(); count and radius of the lookup are not used.
  Rgb irradiance(const Vec3& position, const Vec3& normal, PhotonLookup lookup,
                 Rgb* by_light = nullptr, std::size_t unknown = 0, int* found = nullptr) const;

  /// Writes the maps to a CheckpointWriter, or reads them from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    checkpoint.value(radius_);
    for (PhotonMap& map : maps_) map.visit_state(checkpoint);
  }
  bool is_valid() const;

 private:
  float radius_ = 0;                    // of the first size
  std::array<PhotonMap, kSizes> maps_;  // by size, each half as large as the one before
};

}  // namespace oriel
