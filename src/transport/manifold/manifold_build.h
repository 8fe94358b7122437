// SPDX-License-Identifier: Apache-2.0
// Divides caustic photons between the search for chains and maps.
#pragma once

#include "transport/manifold/manifold_caustics.h"

namespace oriel {

/// Finds the starts of the search, and the photons whose chains it does not find.
///
/// Inputs:  radius: of estimates by the photon map, scene units; merge: see PhotonMap.
/// Returns: empty if the search finds too little, in scenes with motion blur or volumes, and if
///          cancelled.
/// Checked: CausticPictures.*, Caustics.* in tests/cross_method
ManifoldCaustics build_manifold_caustics(const World& world, const ChainLog& log, float radius,
                                         float merge, RayCounts& counts,
                                         const ProgressMonitor& monitor);

}  // namespace oriel
