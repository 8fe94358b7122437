// SPDX-License-Identifier: Apache-2.0
// The way of one photon from its source until it is absorbed.
#pragma once

#include "lights/photon_source.h"
#include "sampling/sampler.h"
#include "transport/photon/photon_aim.h"
#include "transport/photon/photon_trace.h"

namespace oriel {

/// A photon in a map before it is known how many were sent.
struct StoredPhoton {
  Photon photon;
  std::uint32_t index = 0;  ///< of the emission
};

/// What a batch of photons left.
struct PhotonLog {
  std::vector<StoredPhoton> global, caustic;
  std::vector<PhotonChain> chains;  ///< of the caustic photons, if the settings request them
  PhotonBalance balance;
  RayCounts counts;
};

/// Sends photon `index` of a source. `stream` tells sources apart.
void walk_photon(const World& world, const PhotonSettings& settings, const PhotonSource& source,
                 const PhotonAim& aim, int stream, std::uint32_t index, PhotonLog& log);

}  // namespace oriel
