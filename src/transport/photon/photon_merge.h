// SPDX-License-Identifier: Apache-2.0
// Fewer photons with the same power: those that lie close together become one.
#pragma once

#include <vector>

#include "transport/photon/photon_map.h"

namespace oriel {

/// Photons one after another join the nearest of those already kept that lies within `distance`
/// and faces the same way (cosine at least `agreement`), of the same layer of lights; position and
/// direction become means by power. Depends on the order of the photons. Checked:
/// PhotonMap.MergingPreservesPower, PhotonMap.MergedPhotonsLieApart.
std::vector<Photon> merge_photons(const std::vector<Photon>& photons, float distance,
                                  float agreement);

}  // namespace oriel
