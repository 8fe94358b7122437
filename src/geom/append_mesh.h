// SPDX-License-Identifier: Apache-2.0
// Several meshes of one object become one.
#pragma once

#include "geom/mesh.h"

namespace oriel::geom {

/// Adds the vertices, triangles and material slots of `part` behind those of `mesh`; both may lack
/// columns that the other has, which then hold null vectors. Both have their spare vertex, and so
/// has the result. Curves are not touched.
/// Checked: AppendMesh.*
void append_mesh(Mesh& mesh, const Mesh& part);

}  // namespace oriel::geom
