// SPDX-License-Identifier: Apache-2.0
// Colours all around, tabulated once and then looked up as blurred as one likes.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace oriel::image {

/// The sphere on the unit square, equal areas for equal solid angles, and back.
///
/// Model:   Octahedron unfolded; opposite halves of each side of the square are joined.
/// Source:  Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008.
/// Checked: SphereSquare.*
Vec2 square_of(const Vec3& direction);
Vec3 direction_of(const Vec2& square);

/// A map over that square, looked up by smooth (quadratic) splines.
class SphereMap {
 public:
  explicit SphereMap(int side = 0);
  int side() const { return side_; }
  Rgba& at(int x, int y) { return texels_[index(x, y)]; }
  const Rgba& at(int x, int y) const { return texels_[index(x, y)]; }
  Vec3 direction(int x, int y) const;
  /// Copies what lies across the sides of the square; before look-ups.
  void close();
  Rgba lookup(const Vec2& square) const;
  /// Means of two by two; the side is even.
  SphereMap halved() const;
  Rgba mean() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>((y + 1) * (side_ + 2) + x + 1);
  }
  int side_;
  std::vector<Rgba> texels_;  // with one more all around
};

/// The same colours blurred by kernels of doubling width.
///
/// Model:   Level j holds them under exp(k_j (cos t - 1)), 1 / k_j = width_j^2. Level 0 is the map,
///          as wide as its texels and splines; each further one is twice as wide. Wider maps have
///          fewer texels. Any kernel that falls off with the angle is a mixture of levels.
/// Inputs:  side: texels each way, rounded up to a multiple of 16. source: colour by direction,
///          asked four times for each texel, on all threads; what is not finite is black.
/// Checked: SphereBlur.*
class SphereBlur {
 public:
  static constexpr int kLevels = 9;
  using Weights = std::array<float, kLevels>;

  SphereBlur(int side, const std::function<Rgba(const Vec3&)>& source);

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
  std::array<SphereMap, kLevels> levels_;
};

}  // namespace oriel::image
