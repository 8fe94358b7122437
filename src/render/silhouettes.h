// SPDX-License-Identifier: Apache-2.0
// Pixels in which objects end before a black background.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/window.h"
#include "runtime/world.h"

namespace oriel {

/// Places of a pixel that one of its samples looks at, where objects end.
inline constexpr std::uint32_t kSilhouettePlaces = 8;

/// A sample that looks at several places of its pixel.
struct SilhouetteSample {
  std::array<Vec2, kSilhouettePlaces> places;  ///< raster; those that meet an object come first
  std::size_t met = 0;                         ///< number of places that meet an object
  Rgb of_met{0}, of_rest{0};                   ///< light of a path through one of them
};

/// The pixels where objects end before a black background. What is hardly covered there has large
/// relative errors, while more places per sample cost little beside the path.
///
/// Model:   one ray goes through the centre of the pixel and of each of its eight neighbours. The
///          pixel is one of them if some of these rays meet an object, and some meet none and see
///          black. Where all rays miss a thin object, its pixels have the noise of other pixels.
///          The result does not depend on which window or part of the picture is rendered.
/// Checked: Silhouettes.* in tests/analytic/camera
class Silhouettes {
 public:
  /// None.
  Silhouettes() = default;
  /// Inputs:  window: the part of the picture that contain() refers to.
  Silhouettes(const World& world, const Window& window);

  /// Inputs:  x, y: pixel of the window, from its top left.
  bool contain(int x, int y) const {
    return !pixels_.empty() &&
           pixels_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
  }

 private:
  std::size_t width_ = 0;
  std::vector<unsigned char> pixels_;
};

}  // namespace oriel
