// SPDX-License-Identifier: Apache-2.0
// Sampling of a 2D table restricted to a rectangle that changes with every draw: an environment map
// seen through a portal.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace oriel::sampling {

/// Rectangle in [0,1]^2.
struct Window {
  Vec2 lo{0}, hi{1};
};

/// Piecewise constant distribution over a window in [0,1]^2.
///
/// Model:   a summed-area table, interpolated bilinearly between corners, so the integral of any
///          window takes four lookups. Both coordinates are found by bisection.
/// Inputs:  values, row after row (row 0 at v = 0), width x height; negative and non-finite ones
///          count as 0.
/// Returns: densities with respect to area in [0,1]^2; 0 if the window has no weight.
/// Errors:  total.
/// Source:  Crow, "Summed-area Tables for Texture Mapping", 1984; Bitterli, Novak, Jarosz,
///          "Portal-Masked Environment Map Sampling", EGSR 2015.
/// Checked: WindowedDistribution.*
class WindowedDistribution2D {
 public:
  WindowedDistribution2D(std::span<const float> values, std::size_t width, std::size_t height);

  struct Sample {
    Vec2 uv{0};
    float pdf = 0;
  };

  float integral(const Window& window) const;
  Sample sample(const Vec2& u, const Window& window) const;
  /// Density of a point in the window.
  float pdf(const Vec2& uv, const Window& window) const;
  /// The value of the table at a point.
  float value(const Vec2& uv) const;

 private:
  /// A coordinate in units of cells.
  struct Place {
    std::size_t cell;
    double share;  // position inside the cell
  };
  struct Corners {
    Place x0, x1, y0, y1;
  };
  Place place(float x, std::size_t cells) const;
  Corners corners(const Window& window) const;
  double sum(const Place& x, const Place& y) const;
  double column(std::size_t x, const Place& y) const;
  double precise_integral(const Corners& at) const;

  std::size_t width_, height_;
  std::vector<float> values_;
  // double: sums of windows are small differences of large sums
  std::vector<double> sums_;  // (width + 1) x (height + 1)
};

}  // namespace oriel::sampling
