// SPDX-License-Identifier: Apache-2.0
// Final gathering for a picture: passes that place points where the eye sees surfaces.
#pragma once

#include "runtime/window.h"
#include "transport/gather/gather_points.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// What the passes go by.
struct GatherPasses {
  GatherSettings records;
  GatherQuery covered;  ///< a point that such a look-up answers needs no record
  float density = 1;    ///< points for each that the grid of density 1 has
  std::uint32_t seed = 0;
};

/// Where the coarsest pass would gather.
std::vector<GatherPoint> first_gather_points(const World& world, const Window& window,
                                             const GatherPasses& passes, RayCounts& counts);

/// Adds records until every surface seen through the finest grid has some.
///
/// Model:   passes over ever finer grids of the picture: a pass asks the cache as it stands,
///          gathers where it has no record, and adds all new records in the order of pixels; so
///          the result does not depend on threads. After each pass radii are clamped to the
///          neighbours' and `after_pass` is called.
/// Checked: tests/cross_method, GatherOptions.* in tests/analytic
void gather_for_picture(const World& world, const Window& window, const GatherPasses& passes,
                        GatherCache& cache, RayCounts& counts, const ProgressMonitor& monitor,
                        const std::function<void()>& after_pass);

}  // namespace oriel
