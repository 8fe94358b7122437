// SPDX-License-Identifier: Apache-2.0
// Final gathering for a picture: passes that place records on visible surfaces.
#pragma once

#include "runtime/window.h"
#include "transport/gather/gather_points.h"
#include "transport/progress_monitor.h"
#include "transport/work_share.h"

namespace oriel {

/// Settings of the passes.
struct GatherPasses {
  GatherSettings records;
  GatherQuery covered;  ///< a point for which this look-up succeeds needs no record
  float density = 1;    ///< number of points relative to the grid of density 1
  std::uint32_t seed = 0;
};

/// The gather points of the coarsest pass.
std::vector<GatherPoint> first_gather_points(const World& world, const Window& window,
                                             const GatherPasses& passes, RayCounts& counts);

/// Adds records until every surface that is visible through the finest grid is covered.
///
/// Model:   passes over increasingly fine grids of the picture. A pass looks up the current cache,
///          gathers where no record applies, and inserts all new records in the order of pixels, so
///          the result does not depend on the number of threads. After each pass radii are clamped
///          to those of neighbours and `after_pass` is called.
/// Inputs:  share: processes with the same cache that compute rows of the passes together; null =
///          this one alone. The cache is the same either way, and `counts` contains the rays of
///          all processes.
/// Checked: tests/cross_method, GatherOptions.* in tests/analytic
void gather_for_picture(const World& world, const Window& window, const GatherPasses& passes,
                        GatherCache& cache, RayCounts& counts, const ProgressMonitor& monitor,
                        const std::function<void()>& after_pass, WorkShare* share = nullptr);

}  // namespace oriel
