// SPDX-License-Identifier: Apache-2.0
// Light of photons near the edges of surfaces.
#pragma once

#include "runtime/world.h"
#include "transport/photon/photon_map.h"

namespace oriel {

/// Makes up for the light that estimates lose at edges, where part of their disc is beside the
/// surface or behind a wall.
///
/// Model:   the power of each photon is divided by the share of its own disc that lies on surfaces
///          that it may light, so that each photon brings all of its power to the surface. The
///          share is that of kSamples points of the disc; a point counts if a ray along the surface
///          reaches it and one from above finds a surface that faces the same way. Photons whose
///          disc is cut by a wall are marked, so that estimates with PhotonLookup::walls_of leave
///          out those behind walls. Transparent surfaces hide nothing.
/// Inputs:  lookup: that of the estimates. A map must be passed once.
/// Checked: PhotonEdges.*
void keep_light_at_edges(PhotonMap& map, const World& world, const PhotonLookup& lookup);

}  // namespace oriel
