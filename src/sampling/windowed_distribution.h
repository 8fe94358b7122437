// SPDX-License-Identifier: Apache-2.0
// Random choice by a tabulated picture of which only a rectangle counts that changes with every
// draw: an environment seen through a window.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace oriel::sampling {

/// Part of [0,1]^2.
struct Window {
  Vec2 lo{0}, hi{1};
};

/// Piecewise constant distribution over a window in [0,1]^2.
///
/// Model:   sums over all cells below and left of each corner of the table; between corners they
///          are bilinear, so that any window's integral takes four of them, and both coordinates
///          are found by bisection.
/// Inputs:  values, row after row (row 0 at v = 0), width x height; negative and non-finite ones
///          count as 0.
/// Returns: densities with respect to area in [0,1]^2; 0 where the window holds nothing.
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
  /// The table at a point.
  float value(const Vec2& uv) const;

 private:
  /// A coordinate in cells.
  struct Place {
    std::size_t cell;
    double share;  // of that cell
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
  // double: windows are small differences of large sums
  std::vector<double> sums_;  // (width + 1) x (height + 1)
};

}  // namespace oriel::sampling
