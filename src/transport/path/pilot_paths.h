// SPDX-License-Identifier: Apache-2.0
// A few paths before the picture, to choose between settings of paths.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/window.h"
#include "transport/path/path.h"

namespace oriel {

/// Paths of each pixel.
inline constexpr int kPilotPathsOfPixel = 16;

/// Some settings relative to others.
struct PilotComparison {
  float noise = 1, cost = 1;
  /// How many times sooner the others reach the same noise.
  float efficiency() const { return noise * cost; }
};

/// Paths of some pixels by one choice of settings.
///
/// Model:   two means of eight stratified paths for each pixel. Noise is the squared difference of
///          the means, relative to the light of the pixel or of its block of the picture, averaged
///          over channels and pixels, without the few pixels where it is largest. Light that one
///          choice has in those few alone is noise, too. Cost is counted in rays. The same for any
///          number of threads.
/// Checked: PilotPaths.* in tests/analytic
class PilotPaths {
 public:
  /// Inputs:  window: the part of the picture that camera rays cover; pixels: rounded down to a
  ///          multiple of 64.
  PilotPaths(const World& world, const Window& window, const PathSettings& settings,
             std::uint32_t seed, RayCounts& counts, std::size_t pixels = 512);

  /// `others` relative to these. Inputs:  others: of the same window, seed and number of pixels.
  /// Returns: 1 without any light.
  PilotComparison compare(const PilotPaths& others) const;
  /// The same if `others` trace the same paths and find by chance some light that these have
  /// without noise. All that they find counts as their noise, even in very few pixels.
  PilotComparison compare_finds(const PilotPaths& others) const;
  /// Squared noise of a pixel that has one path, relative to its light; mean over the pixels.
  double noise_of_path() const;

 private:
  struct Pixel {
    std::array<Rgb, 2> means{Rgb(0), Rgb(0)};
    std::size_t block = 0;  ///< part of the window
  };
  static Pixel trace(const World& world, const Window& window, const PathSettings& settings,
                     std::uint32_t pixel, std::uint32_t seed, RayCounts& counts);
  /// Light by which noise of each pixel is divided, from both choices.
  static std::vector<Rgb> levels(const PilotPaths& a, const PilotPaths& b);
  /// Squared relative noise of a mean. Light that only the others have counts as well.
  double noise(const std::vector<Rgb>& levels, const PilotPaths& others) const;

  std::vector<Pixel> pixels_;
  double cost_ = 0;  ///< in rays
};

}  // namespace oriel
