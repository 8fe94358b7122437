// SPDX-License-Identifier: Apache-2.0
// Blurred lookups of a spherical colour function from precomputed levels.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace oriel::image {

/// A cube map with lookups by smooth (quadratic) splines.
///
/// Model:   texels of a face cover equal angles at the centre of the cube. Each face is extended by
///          one texel beyond its edges, so lookups have no seams.
class CubeMap {
 public:
  explicit CubeMap(int side = 0);
  int side() const { return side_; }
  /// A texel; x and y from -1 to side, where -1 and side are beyond the edge.
  Rgba& at(int face, int x, int y) { return texels_[index(face, x, y)]; }
  const Rgba& at(int face, int x, int y) const { return texels_[index(face, x, y)]; }
  /// Direction of a point on a face; the centre of texel (x, y) is at (x + 0.5, y + 0.5).
  Vec3 direction(int face, float x, float y) const;
  Rgba lookup(const Vec3& direction) const;
  /// Sets all texels, in parallel.
  void fill(const std::function<Rgba(int face, int x, int y)>& colour);
  /// The map at half the resolution (means of 2 x 2 texels); requires an even side.
  CubeMap halved() const;
  /// Mean weighted by solid angle.
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

/// A spherical function blurred by kernels of doubling width.
///
/// Model:   level j is convolved with exp(k_j (cos t - 1)), 1 / k_j = width_j^2. Level 0 has the
///          width of its texels and splines; each further level is twice as wide and may have fewer
///          texels. Any kernel that falls off with the angle is approximated by a mixture of
///          levels.
/// Inputs:  samples: minimum number of texels; sides of the cube are multiples of 16. source:
///          colour by direction, evaluated four times per texel on all threads; values that are not
///          finite count as black.
/// Checked: SphereBlur.*
class SphereBlur {
 public:
  static constexpr int kLevels = 9;
  using Weights = std::array<float, kLevels>;

  SphereBlur(int samples, const std::function<Rgba(const Vec3&)>& source);

  int side() const { return levels_[0].side(); }
  /// Kernel width of a level along one axis, in radians.
  float width(int level) const;
  /// Weighted sum of the levels; the weights add up to 1.
  Rgba lookup(const Vec3& direction, const Weights& weights) const;
  /// The weights of the levels that approximate a kernel.
  ///
  /// Inputs:  kernel: density per solid angle as a function of the angle (radians, 0 ... pi).
  /// Model:   minimises the Kullback-Leibler divergence by expectation maximisation.
  Weights weights_of(const std::function<float(float)>& kernel) const;

 private:
  std::array<CubeMap, kLevels> levels_;
};

}  // namespace oriel::image
