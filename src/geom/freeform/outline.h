// SPDX-License-Identifier: Apache-2.0
// The edges of a surface in its parameter plane: its own border, trims, holes, special curves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geom/freeform/sampling.h"

namespace oriel::geom::freeform {

/// A place on an edge. Where surfaces are connected both have the same `place` there.
struct EdgePoint {
  double u, v;
  std::optional<V3d> place;
};

struct Polyline {
  scene::SurfaceLoop::Kind kind = scene::SurfaceLoop::Kind::Trim;
  std::vector<EdgePoint> points;  ///< trims and holes are closed, without repeating the first
};

/// Where a connection asks a trimming curve for points: parameters of the curve, ascending, and the
/// places they have. Between the first and the last the curve has no others.
struct Seam {
  std::vector<double> t;
  std::vector<V3d> place;
};

/// NamedCurves of a group by name.
using NamedCurves = std::map<std::string, CurveNet, std::less<>>;

/// How a trimming curve is approximated: by its own statement, by `trim` of its surface, or as the
/// surface is.
using CurveApproximation = std::function<const scene::Approximation&(const std::string& curve)>;

/// What a surface's edges are made from.
struct OutlineInput {
  const SurfaceNet& net;
  Range range;
  const NamedCurves& curves;
  const std::map<std::string, Seam>& seams;  ///< of this surface, by curve
  CurveApproximation approximation;
  const scene::Approximation& of_surface;
  const scene::TessellationView& view;
};

/// The surface's own border, counter-clockwise.
Polyline border(const OutlineInput& input, Budget& budget);

/// One trim, hole or special statement. `fault` names a curve that does not exist; parts of it are
/// left out.
Polyline flatten(const scene::SurfaceLoop& loop, const OutlineInput& input, Budget& budget,
                 std::string& fault);

/// Parameters at which a part of a curve on the surface is sampled, from its smaller to its larger
/// end.
std::vector<double> sample_part(const CurveNet& curve, const scene::CurvePart& part,
                                const OutlineInput& input, Budget& budget);

/// The surface at a point of the parameter plane, which is moved into its range.
V3d on_surface(const OutlineInput& input, const V3d& uv);

}  // namespace oriel::geom::freeform
