// SPDX-License-Identifier: Apache-2.0
// Merges several meshes of one object.
#pragma once

#include "geom/mesh.h"

namespace oriel::geom {

/// Appends the vertices, triangles and material slots of `part` to `mesh`. A column that only one
/// of them has is filled with null vectors. Both meshes have the spare vertex at the end, and so
/// has the result. Curves are unchanged.
/// Checked: AppendMesh.*
void append_mesh(Mesh& mesh, const Mesh& part);

}  // namespace oriel::geom
