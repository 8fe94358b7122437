// SPDX-License-Identifier: Apache-2.0
// A few paths before the picture, to choose between settings of paths.
#pragma once

#include "runtime/window.h"
#include "transport/path/path.h"

namespace oriel {

/// Paths of each pixel in a comparison.
inline constexpr int kPilotPathsOfPixel = 32;

/// Settings `b` relative to settings `a`.
struct PilotComparison {
  float noise = 1, cost = 1;
  /// How many times sooner `a` reaches the same noise.
  float efficiency() const { return noise * cost; }
};

/// Compares settings by a few paths.
///
/// Model:   two means of eight stratified paths for each of some pixels, by both settings; noise is
///          the squared difference of the means, relative to the pixel and averaged over channels
///          and pixels, without the hundredth of the pixels where it is largest. Cost is counted in
///          rays.
/// Inputs:  window: the part of the picture that camera rays cover; pixels: rounded down to a
///          multiple of 64.
/// Returns: 1 without any light. The same for any number of threads.
/// Checked: PilotPaths.* in tests/analytic
PilotComparison compare_pilots(const World& world, const Window& window, const PathSettings& a,
                               const PathSettings& b, std::uint32_t seed, RayCounts& counts,
                               std::size_t pixels = 512);

}  // namespace oriel
