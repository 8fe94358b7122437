// SPDX-License-Identifier: Apache-2.0
// The edges of a surface in its parameter plane: border, trims, holes, special curves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geom/freeform/sampling.h"

namespace oriel::geom::freeform {

/// A point on an edge. Connected surfaces have the same `place` there.
struct EdgePoint {
  double u, v;
  std::optional<V3d> place;
};

struct Polyline {
  scene::SurfaceLoop::Kind kind = scene::SurfaceLoop::Kind::Trim;
  std::vector<EdgePoint> points;  ///< trims and holes are closed; the first point is not repeated
};

/// Sample points that a connection prescribes for a trimming curve: ascending parameters and their
/// positions. The curve has no other samples between the first and the last.
struct Seam {
  std::vector<double> t;
  std::vector<V3d> place;
};

/// The curves of a group by name.
using NamedCurves = std::map<std::string, CurveNet, std::less<>>;

/// The approximation of a trimming curve: its own, else that of `trim` of its surface, else that of
/// the surface.
using CurveApproximation = std::function<const scene::Approximation&(const std::string& curve)>;

/// Input for the edges of a surface.
struct OutlineInput {
  const SurfaceNet& net;
  Range range;
  const NamedCurves& curves;
  const std::map<std::string, Seam>& seams;  ///< seams of this surface, by curve
  CurveApproximation approximation;
  const scene::Approximation& of_surface;
  const scene::TessellationView& view;
};

/// The border of the surface, counter-clockwise.
Polyline border(const OutlineInput& input, Budget& budget);

/// Samples one trim, hole or special curve. Parts whose curve does not exist are skipped and named
/// in `fault`.
Polyline flatten(const scene::SurfaceLoop& loop, const OutlineInput& input, Budget& budget,
                 std::string& fault);

/// Parameters of the samples of a curve part on the surface, in ascending order.
std::vector<double> sample_part(const CurveNet& curve, const scene::CurvePart& part,
                                const OutlineInput& input, Budget& budget);

/// The surface at a point of the parameter plane, clamped to its range.
V3d on_surface(const OutlineInput& input, const V3d& uv);

}  // namespace oriel::geom::freeform
