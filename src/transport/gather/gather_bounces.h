// SPDX-License-Identifier: Apache-2.0
// Light that diffuse surfaces send each other before it is gathered: coarse records behind the fine
// ones.
#pragma once

#include "transport/gather/gather_points.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// What a coarse cache holds when it is ready.
struct Bounces {
  GatherCache cache;
  GatherQuery query;  ///< how it is asked
  int held = 0;       ///< bounces in it; PathSettings::kAllBounces: all of them
};

/// Gathers at points that gather rays of `seen` meet, and that rays from there meet.
///
/// Model:   Jacobi iteration on fixed points: the records of a round gather what those of the round
///          before send back, so round k holds k bounces. When a round changes little, those still
///          wanted are taken for a geometric series with the ratio of the last two. Where there is
///          no record, rays go on as paths.
/// Inputs:  seen: where the picture gathers; settings: of its records; their path.diffuse_bounces
///          says how many bounces are wanted, above 0.
/// Checked: tests/cross_method
Bounces gather_bounces(const World& world, const std::vector<GatherPoint>& seen,
                       const GatherSettings& settings, std::uint32_t seed, RayCounts& counts,
                       const ProgressMonitor& monitor);

}  // namespace oriel
