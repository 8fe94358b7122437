// SPDX-License-Identifier: Apache-2.0
// Samples curves and surfaces such that an approximation is satisfied.
#pragma once

#include <functional>
#include <vector>

#include "geom/freeform/net.h"
#include "scene/approximation.h"

namespace oriel::geom::freeform {

/// Remaining number of points; limits the memory that a scene can request.
struct Budget {
  std::size_t points = 4'000'000;
  bool spent = false;
  bool take(std::size_t count) {
    if (count > points) spent = true;
    points -= spent ? 0 : count;
    return !spent;
  }
};

/// Compares lengths and angles with the limits of an approximation.
class Criteria {
 public:
  Criteria(const scene::Approximation& approximation, const scene::TessellationView& view)
      : a_(approximation), view_(view) {}

  /// Length in the units of the limits: object space or pixels.
  double length(const V3d& a, const V3d& b) const;
  /// The largest quotient of a measure and its limit, over the criteria in use; with `any` the
  /// smallest. At most 1 if the criteria are met; 0 without criteria.
  double excess(double length, double distance, double angle) const;
  bool wants_angle() const { return a_.angle > 0; }

 private:
  const scene::Approximation& a_;
  const scene::TessellationView& view_;
};

/// Parameters from t0 to t1 (t0 < t1), both included, ascending.
///
/// Model:   parametric and regular give the number of pieces. With criteria, each span (bounded by
///          `breaks`) is bisected until its chord length, the distance from the chord and the
///          tangent angle are within limits. The result depends only on the curve and its
///          approximation, so two surfaces that share both have the same points.
/// Inputs:  factor: number of pieces of the approximation, for u or v.
std::vector<double> sample_curve(const std::function<V3d(double)>& at,
                                 const std::vector<double>& breaks, int degree, double t0,
                                 double t1, const scene::Approximation& approximation, float factor,
                                 const Criteria& criteria, Budget& budget);

/// A rectangle in the parameter plane of a surface.
struct Range {
  double u0, u1, v0, v1;
};

/// Calls back with each cell of the surface, in any order. Cells are bisected along u or v, in the
/// direction of the larger error. The cell with the largest error is bisected first, until the
/// cells (two triangles each) reach the maximum of `max`; edges and trims add further triangles.
void sample_surface(const SurfaceNet& surface, const Range& range,
                    const scene::Approximation& approximation, const Criteria& criteria,
                    Budget& budget, const std::function<void(const Range&)>& cell);

/// The values of `breaks` inside (t0, t1), with both ends.
std::vector<double> breaks_between(const std::vector<double>& breaks, double t0, double t1);

}  // namespace oriel::geom::freeform
