// SPDX-License-Identifier: Apache-2.0
// Connections: the points two surfaces share along their trimming curves.
#pragma once

#include <utility>

#include "geom/freeform/outline.h"

namespace oriel::geom::freeform {

struct SeamSide {
  OutlineInput input;
  const CurveNet& curve;
  const scene::CurvePart& part;
};

/// The seam as each of the two sees it: as many points, at the same places.
///
/// Model:   the samples either side asks for, by the share of the way along its part; the places
/// are
///          those of the first surface, the second's parameters are the nearest to them.
/// Checked: FreeForm.ConnectedSurfacesShareTheirEdge
std::pair<Seam, Seam> make_seam(const SeamSide& a, const SeamSide& b, Budget& budget);

}  // namespace oriel::geom::freeform
