// SPDX-License-Identifier: Apache-2.0
// Readers of free-form curves and surfaces. Each one is called after its keyword.
#pragma once

#include "mi/polygons.h"

namespace oriel::mi {

/// basis "n" [rational] bezier N | bspline N | taylor N | cardinal | matrix N N f...
void read_basis(Parse& parse, scene::Object& object, SourceLocation at);
/// [space] curve "n" [rational] "basis" parameters... points... [special ...]
void read_curve(Parse& parse, const scene::Object& object, scene::PolygonGroup& group, bool space,
                SourceLocation at);
/// surface "n" material [rational] "basis" min max parameters... the same for v, points...
/// { derivative ... | [volume] [vector] texture ... | trim ... | hole ... | special ... }
void read_surface(Parse& parse, const scene::Object& object, scene::PolygonGroup& group,
                  GroupBuilder& builder, SourceLocation at);
/// connect "surface" "curve" min max "surface" "curve" min max
void read_connection(Parse& parse, scene::PolygonGroup& group, SourceLocation at);

}  // namespace oriel::mi
