// SPDX-License-Identifier: Apache-2.0
// Displacement shaders of materials, applied to the vertices of a mesh before rendering.
#pragma once

#include <span>
#include <vector>

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "runtime/world.h"
#include "scene/hierarchy.h"

namespace oriel {

/// Displacement shaders of the material of each slot of a mesh; empty if no slot has any.
using Displacement = std::vector<NodeList>;

/// The displacement of a mesh whose slots have these materials (indices into World::materials);
/// empty if the options disable displacement.
Displacement displacement_of(std::span<const int> materials, const World& world);

/// Moves each vertex along its normal by the sum of the shaders' results, in object units.
///
/// Model:   the mesh is displaced without refinement (refine_displacement.h refines it before);
///          shaders are evaluated once per vertex, unfiltered. Vertices at one position move
///          together, by the mean of their amounts along the mean of their corners' normals, so no
///          crack opens at edges where normals, coordinates or slots differ; only corners of
///          displaced slots count. Normals rotate with the facets around them: smooth edges stay
///          smooth and sharp edges stay sharp. Bump bases and derivatives rotate with them (their
///          lengths are kept). A mesh without vertex normals moves along the mean of its facets'
///          normals and stays faceted. Infinite amounts and NaN count as 0.
/// Inputs:  leaf: the placement that shaders see: that of the first instance of the mesh.
/// Errors:  OR-RN-031 once if `max displace` of the object (or of the options; 0 = unlimited)
///          clamps an amount.
/// Source:  reference of the language, Material and Object; shader interface, displacement shaders.
/// Checked: Displacement.* in tests/analytic
void displace(geom::Mesh& mesh, const Displacement& displacement, const scene::Leaf& leaf,
              const World& world, Diagnostics& diagnostics);

}  // namespace oriel
