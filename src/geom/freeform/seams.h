// SPDX-License-Identifier: Apache-2.0
// Connections: the points that two surfaces share along their trimming curves.
#pragma once

#include <utility>

#include "geom/freeform/outline.h"

namespace oriel::geom::freeform {

struct SeamSide {
  OutlineInput input;
  const CurveNet& curve;
  const scene::CurvePart& part;
};

/// The seam for each of the two surfaces, with the same number of points at the same positions.
///
/// Model:   the union of the samples of both sides, by the relative position along the part.
///          Positions are those of the first surface; the parameters of the second are the nearest
///          ones.
/// Checked: FreeForm.ConnectedSurfacesShareTheirEdge
std::pair<Seam, Seam> make_seam(const SeamSide& a, const SeamSide& b, Budget& budget);

}  // namespace oriel::geom::freeform
