// SPDX-License-Identifier: Apache-2.0
// Reader of subdivision surfaces and Catmull-Clark meshes in a group.
#pragma once

#include "mi/polygons.h"

namespace oriel::mi {

/// Reads `subdivision surface ... end subdivision surface` or `ccmesh ... end ccmesh`, starting at
/// the first word.
///
/// Model:   `crease M f...` of a subdivision surface has a bit mask of edges and one sharpness per
///          edge in the mask; the last sharpness also applies to the remaining edges. In a ccmesh
///          it
///          has one sharpness per edge.
/// Errors:  OR-MI-041 for a dropped face. A syntax error ends the object.
/// Source:  the published grammar. The order of mask bits, from the first corner of the face, is
///          inferred.
void read_subdivision(Parse& parse, scene::PolygonGroup& group, GroupBuilder& builder,
                      SourceLocation at);

}  // namespace oriel::mi
