// SPDX-License-Identifier: Apache-2.0
// Where curves and surfaces are sampled so that an approximation's promise holds.
#pragma once

#include <functional>
#include <vector>

#include "geom/freeform/net.h"
#include "scene/approximation.h"

namespace oriel::geom::freeform {

/// How many more points may be made; a scene cannot ask for more memory than that.
struct Budget {
  std::size_t points = 4'000'000;
  bool spent = false;
  bool take(std::size_t count) {
    if (count > points) spent = true;
    points -= spent ? 0 : count;
    return !spent;
  }
};

/// An approximation's lengths and angles against its limits.
class Criteria {
 public:
  Criteria(const scene::Approximation& approximation, const scene::TessellationView& view)
      : a_(approximation), view_(view) {}

  /// In the units of the limits: object space or pixels.
  double length(const V3d& a, const V3d& b) const;
  /// The largest quotient of a measure and its limit, of those that were asked for; with `any` the
  /// smallest. At most 1: all is well. 0 when nothing was asked for.
  double excess(double length, double distance, double angle) const;
  bool wants_angle() const { return a_.angle > 0; }

 private:
  const scene::Approximation& a_;
  const scene::TessellationView& view_;
};

/// Parameters from t0 to t1 (t0 < t1), both included, ascending.
///
/// Model:   by pieces as parametric and regular say; by criteria, each span (cut at `breaks`) is
///          halved until its chord, the curve's distance from it and the turn of the tangent are
///          within limits. Only the curve itself decides, so that two surfaces with a common curve
///          and approximation have the same points on it.
/// Inputs:  factor: the pieces' number that counts here, u or v of the approximation.
std::vector<double> sample_curve(const std::function<V3d(double)>& at,
                                 const std::vector<double>& breaks, int degree, double t0,
                                 double t1, const scene::Approximation& approximation, float factor,
                                 const Criteria& criteria, Budget& budget);

/// The part of a surface that counts, in its parameters.
struct Range {
  double u0, u1, v0, v1;
};

/// Calls back with each cell the surface is cut into, in no order. Cells are halved along u or v,
/// where the approximation is missed most. The cell that misses it most goes first, until the cells
/// make as many triangles as `max` allows, two each; what edges and trims add comes on top.
void sample_surface(const SurfaceNet& surface, const Range& range,
                    const scene::Approximation& approximation, const Criteria& criteria,
                    Budget& budget, const std::function<void(const Range&)>& cell);

/// `breaks` inside of (t0, t1), with both ends.
std::vector<double> breaks_between(const std::vector<double>& breaks, double t0, double t1);

}  // namespace oriel::geom::freeform
