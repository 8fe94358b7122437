// SPDX-License-Identifier: Apache-2.0
// A few paths before the picture, to choose between settings of paths.
#pragma once

#include "runtime/window.h"
#include "transport/path/path.h"

namespace oriel {

/// How many times sooner settings `a` reach the same noise as settings `b`.
///
/// Model:   two paths for each of some pixels; the squared difference, relative to the pixel, times
///          the cost of the paths, which is counted in rays. Bright samples are limited, so that a
///          single one does not decide.
/// Inputs:  window: the part of the picture that camera rays cover; pixels: a multiple of 64.
/// Returns: the ratio for `b` to `a`; 1 without any light. The same for any number of threads.
/// Checked: PilotPaths.* in tests/analytic
float efficiency_ratio(const World& world, const Window& window, const PathSettings& a,
                       const PathSettings& b, std::uint32_t seed, RayCounts& counts,
                       std::size_t pixels = 2048);

}  // namespace oriel
