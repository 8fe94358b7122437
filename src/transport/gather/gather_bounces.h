// SPDX-License-Identifier: Apache-2.0
// Diffuse interreflection before final gathering: coarse irradiance records that gather rays read.
#pragma once

#include "transport/gather/gather_points.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// Records of a coarse cache.
inline constexpr std::size_t kMostBounceRecords = 4096;

/// A coarse irradiance cache that is ready for look-ups.
struct Bounces {
  GatherCache cache;
  GatherQuery query;  ///< settings of look-ups
  int held = 0;       ///< number of bounces in the records; PathSettings::kAllBounces = all
  std::vector<GatherPoint> points = {};  ///< of the records
};

/// The look-ups of records with these radii.
GatherQuery bounces_query(const GatherRadii& radii);

/// Computes records at the points that gather rays from `seen` hit, and at those that rays from
/// there hit.
///
/// Model:   Jacobi iteration on fixed points: the records of a round gather the light that the
///          records of the previous round reflect, so round k contains k bounces. Once a round
///          changes little, the remaining bounces are extrapolated as a geometric series with the
///          ratio of the last two rounds. Rays that hit points without a record continue as paths.
///          Radii follow the diagonal of the space that the picture shows, which nine tenths of the
///          rays between its surfaces tell; it is at most that of the scene.
/// Inputs:  seen: the gather points of the picture; settings: those of its records;
///          settings.path.diffuse_bounces is the number of bounces, above 0; most: records.
/// Checked: tests/cross_method
Bounces gather_bounces(const World& world, const std::vector<GatherPoint>& seen,
                       const GatherSettings& settings, std::uint32_t seed, RayCounts& counts,
                       const ProgressMonitor& monitor, std::size_t most = kMostBounceRecords);

}  // namespace oriel
