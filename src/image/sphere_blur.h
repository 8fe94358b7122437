// SPDX-License-Identifier: Apache-2.0
// Colours all around, tabulated once and then looked up as blurred as one likes.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace oriel::image {

/// Colours all around on the six faces of a cube, looked up by smooth (quadratic) splines.
///
/// Model:   Steps along a face are equal angles at the middle of the cube. Each face goes on by one
///          texel beyond its edges, so that look-ups meet no seam.
class CubeMap {
 public:
  explicit CubeMap(int side = 0);
  int side() const { return side_; }
  /// A texel; x and y from -1 to side, those outside being beyond the edge.
  Rgba& at(int face, int x, int y) { return texels_[index(face, x, y)]; }
  const Rgba& at(int face, int x, int y) const { return texels_[index(face, x, y)]; }
  /// Towards a point of a face; 0.5 more than x or y is the middle of a texel.
  Vec3 direction(int face, float x, float y) const;
  Rgba lookup(const Vec3& direction) const;
  /// Sets all texels, on all threads.
  void fill(const std::function<Rgba(int face, int x, int y)>& colour);
  /// Means of two by two; the side is even.
  CubeMap halved() const;
  /// By solid angle.
  Rgba mean() const;

 private:
  std::size_t index(int face, int x, int y) const {
    const auto size = [](int i) { return static_cast<std::size_t>(i); };
    const int column = x + 1, line = y + 1;
    const std::size_t row = size(side_) + 2;
    return (size(face) * row + size(line)) * row + size(column);
  }
  float solid_angle(float x, float y) const;
  int side_;
  std::vector<Rgba> texels_;
};

/// The same colours blurred by kernels of doubling width.
///
/// Model:   Level j holds them under exp(k_j (cos t - 1)), 1 / k_j = width_j^2. Level 0 is the map,
///          as wide as its texels and splines; each further one is twice as wide. Wider maps have
///          fewer texels. Any kernel that falls off with the angle is a mixture of levels.
/// Inputs:  samples: texels at least; sides of the cube are multiples of 16. source: colour by
///          direction, asked four times for each texel, on all threads; what is not finite is
///          black.
/// Checked: SphereBlur.*
class SphereBlur {
 public:
  static constexpr int kLevels = 9;
  using Weights = std::array<float, kLevels>;

  SphereBlur(int samples, const std::function<Rgba(const Vec3&)>& source);

  int side() const { return levels_[0].side(); }
  /// Radians: of the level's kernel, across one axis.
  float width(int level) const;
  /// Sum of the levels under weights that add up to 1.
  Rgba lookup(const Vec3& direction, const Weights& weights) const;
  /// The weights by which levels are most like a kernel.
  ///
  /// Inputs:  kernel: density per solid angle by angle (radians, 0 ... pi).
  /// Model:   least Kullback-Leibler divergence, found by expectation maximisation.
  Weights weights_of(const std::function<float(float)>& kernel) const;

 private:
  std::array<CubeMap, kLevels> levels_;
};

}  // namespace oriel::image
