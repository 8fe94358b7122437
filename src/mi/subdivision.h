// SPDX-License-Identifier: Apache-2.0
// Subdivision surfaces and Catmull-Clark meshes of a group.
#pragma once

#include "mi/polygons.h"

namespace oriel::mi {

/// `subdivision surface ... end subdivision surface` or `ccmesh ... end ccmesh`, whose first word
/// stands next.
///
/// Model:   `crease M f...` of a subdivision surface has a mask of edges and the sharpness of each
///          edge in it, the last one for those that have none; in a ccmesh one number for each
///          edge.
/// Errors:  OR-MI-041 for a face that is dropped. A syntax error ends the object.
/// Source:  the published grammar; that masks count edges from the face's first corner is inferred.
void read_subdivision(Parse& parse, scene::PolygonGroup& group, GroupBuilder& builder,
                      SourceLocation at);

}  // namespace oriel::mi
