// SPDX-License-Identifier: Apache-2.0
// The light that arrives at the points of a coarse cache, for the directions of diffuse bounces.
#pragma once

#include "transport/direction_guide.h"
#include "transport/gather/gather_bounces.h"

namespace oriel {

/// Traces rays from the points of coarse records and adds up their light, with what the records
/// behind reflect. Light that the samples of lights at the point find as well counts by the MIS
/// weight of the ray.
///
/// Inputs:  rays: of each point, about; pass: calls with different numbers trace
///          different rays.
/// Checked: Guiding.*, GuidedPictures.* in tests/cross_method
std::vector<GuidePoint> guide_points(const World& world, const Bounces& coarse, int rays,
                                     std::uint32_t pass, std::uint32_t seed, RayCounts& counts,
                                     const ProgressMonitor& monitor);

}  // namespace oriel
